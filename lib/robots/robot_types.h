#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/xml_parser.h"

namespace robosim {

/// Where a robot type is told: in a file, or in a text that came from elsewhere.
struct RobotTypeFile {
  std::filesystem::path file;       ///< names it in errors
  std::optional<std::string> text;  ///< nullopt: as the file has it

  /// @throws ConfigError as readXmlFile() does.
  XmlElement read() const { return text ? parseXml(*text, file.string()) : readXmlFile(file); }
};

/// By name.
using RobotTypes = std::map<std::string, RobotTypeFile>;

/// Where robot types are looked for: `robots/` beside the world file, then `robots/` in the folder of worlds that came
/// with RoboSim, or in the one that the environment variable ROBOSIM_WORLDS names instead.
std::vector<std::filesystem::path> robotTypeFolders(const std::filesystem::path& world_file);

/// The robot types in some folders: each `*.xml`; of two with the same name, the earlier folder's.
RobotTypes robotTypesIn(const std::vector<std::filesystem::path>& folders);

}  // namespace robosim
