#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "stage/stage_world.h"
#include "world/file_provider.h"

namespace robosim {

/// Seed of a run for which none is given.
constexpr std::uint64_t kDefaultSeed = 1;

/// All files that define a world, as text, and the seed of its run. The same source gives the same World and Fleet, bit
/// for bit, on any machine without access to files.
struct WorldSource {
  std::string file;  ///< names it in errors; its stem names the world
  std::string text;
  RobotTypes robot_types;  ///< the types that the world uses, each with its text
  FileTexts files{};       ///< its maps and included files, by their FileProvider names
  /// Determines the places of scattered robots and objects; nullopt: kDefaultSeed, or that of the program that loads
  /// it.
  std::optional<std::uint64_t> seed{};
};

/// What a world of Stage has that RoboSim has not.
struct StageNotes {
  std::vector<std::string> lines;  ///< TranslatedStageWorld::notes
  TranslatedStageWorld::Properties properties;
};

/// Reads a world file and the files that it refers to. A world of Stage (isStageFile()) is translated.
/// @param notes receives what is left out of a world of Stage; null: its number is logged
/// @throws ConfigError when the file of the world, a robot type, a map or an included file cannot be read. loadWorld()
/// reports faults in their contents.
WorldSource readWorldSource(const std::filesystem::path& file, StageNotes* notes = nullptr);
/// Completes the text of a world file by the files that it refers to, as if it were in `file`, which need not exist.
/// @throws ConfigError as readWorldSource()
WorldSource completeWorldSource(std::string text, const std::filesystem::path& file);

/// Equivalent to loadWorld() of a file.
LoadedWorld loadWorld(const WorldSource&, const ControllerCheck& check_controller);

/// Hash of a source's contents, which does not depend on the names of its files, nor on the seed.
std::string versionOf(const WorldSource&);

}  // namespace robosim
