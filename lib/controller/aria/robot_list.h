#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error_list.h"
#include "base/xml_element.h"

namespace robosim {

/// Address of one robot's remote port.
struct RobotAddress {
  std::string name;  ///< of the robot in the world file
  std::string hostname;
  std::uint16_t port = 0;  ///< TCP, [1, 65535]
  bool primary = false;    ///< the one that is driven first; the others run autonomously
  bool operator==(const RobotAddress&) const = default;
};

/// Reads a robot list: <RobotInfo> of 2005, in the file's order. Adds every error to `errors` as "file:line: error;
/// fix": XML errors as in world files, duplicate names, no primary robot, or several.
std::vector<RobotAddress> readRobotList(const std::filesystem::path& file, ErrorList& errors);
/// The same from a file's root element; `file` names it in errors.
std::vector<RobotAddress> robotListFrom(const XmlElement& root, const std::string& file, ErrorList& errors);

}  // namespace robosim
