#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "world/file_shelf.h"

namespace robosim {

/// All that a world is made from, as text: whoever has it builds the same World and Fleet, bit for bit, without a file
/// of his own.
struct WorldSource {
  std::string file;  ///< names it in errors; its stem names the world
  std::string text;
  RobotTypes robot_types;  ///< those that the world names, each with its text
  FileTexts files{};       ///< its maps, by the names that FileShelf has for them
};

/// @throws ConfigError when the world's file, or that of a robot type or a map, cannot be read. What is wrong inside,
/// loadWorld() tells.
WorldSource readWorldSource(const std::filesystem::path& file);

/// As loadWorld() of a file.
/// @throws ConfigError with every fault found.
LoadedWorld loadWorld(const WorldSource&, const std::vector<std::string>& controllers);

/// Short text that is another for every other source. What the files are called is no part of it.
std::string versionOf(const WorldSource&);

}  // namespace robosim
