#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error_list.h"

namespace robosim {

/// Where one robot's program listens for its remote control.
struct RobotAddress {
  std::string name;  ///< of the robot in the world file
  std::string hostname;
  std::uint16_t port = 0;  ///< TCP, [1, 65535]
  bool primary = false;    ///< the one that is driven first; the others run autonomously
  bool operator==(const RobotAddress&) const = default;
};

/// Reads a robot list: <RobotInfo> of 2005, in the file's order. Adds every fault to `errors` as "file:line: what; the
/// mend": what a world file is refused for, a name given twice, no primary robot, or two.
std::vector<RobotAddress> readRobotList(const std::filesystem::path& file, ErrorList& errors);

}  // namespace robosim
