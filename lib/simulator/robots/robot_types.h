#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace robosim {

/// Source of a robot type: a file, or a text received from elsewhere.
struct RobotTypeFile {
  std::filesystem::path file;       ///< names it in errors
  std::optional<std::string> text;  ///< nullopt: the text of the file
};

/// Robot types by name.
using RobotTypes = std::map<std::string, RobotTypeFile>;

/// Folders searched for robot types: `robots/` beside the world file, then `robots/` in each of worldFolders().
std::vector<std::filesystem::path> robotTypeFolders(const std::filesystem::path& world_file);

/// Robot types in the given folders: every `*.xml`. Of two with the same name, the one in the earlier folder.
RobotTypes robotTypesIn(const std::vector<std::filesystem::path>& folders);

}  // namespace robosim
