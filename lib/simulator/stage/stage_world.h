#pragma once
#include <map>
#include <string>
#include <vector>

#include "world/file_provider.h"

namespace robosim {

/// A world of Stage 2 to 4 (doc/from_stage.md) as files of RoboSim.
struct TranslatedStageWorld {
  std::string text;                                ///< a world file; its maps are the pictures of the Stage world
  std::map<std::string, std::string> robot_types;  ///< texts by name
  std::vector<std::string> notes;                  ///< "file:line: what is left out or changed, and why"
  /// Properties as they are written in the files that the world consists of, apart from those of unused macros.
  struct Properties {
    std::size_t all = 0;
    std::size_t translated = 0;
    std::size_t display = 0;  ///< of Stage's window, clock and threads
    std::size_t ignored = 0;  ///< with a note
  } properties;
};

/// Translates a world file of Stage. Lengths of the result are in metres.
/// @param text of the file @param file names it in errors @param files files beside it: included ones, and bitmaps
/// @throws ConfigError "file:line: what"
TranslatedStageWorld translateStageWorld(const std::string& text, const std::string& file, const FileProvider& files);

}  // namespace robosim
