#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "world/file_provider.h"

namespace robosim {

/// All files that define a world, as text. The same source gives the same World and Fleet, bit for bit, on any machine
/// without access to files.
struct WorldSource {
  std::string file;  ///< names it in errors; its stem names the world
  std::string text;
  RobotTypes robot_types;  ///< the types that the world uses, each with its text
  FileTexts files{};       ///< its maps, by their FileProvider names
};

/// Reads a world file and the files that it refers to.
/// @throws ConfigError when the file of the world, a robot type or a map cannot be read. loadWorld() reports faults in
/// their contents.
WorldSource readWorldSource(const std::filesystem::path& file);

/// Equivalent to loadWorld() of a file.
LoadedWorld loadWorld(const WorldSource&, const ControllerCheck& check_controller);

/// Hash of a source's contents, which does not depend on the names of its files.
std::string versionOf(const WorldSource&);

}  // namespace robosim
