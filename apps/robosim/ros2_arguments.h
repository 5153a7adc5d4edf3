#pragma once
#include <optional>
#include <string>
#include <vector>

#include "robosim/cli11_names.h"

namespace robosim {

/// Arguments of --ros2 and the options that belong to it.
struct Ros2Arguments {
  bool is_on = false;
  std::optional<int> domain;  ///< nullopt: ROS_DOMAIN_ID, or 0
  std::string name_space;
  std::string interface;
  std::vector<std::string> peers;
  std::string trees = "common";  ///< of frames: "common" or "robot"
  bool is_unprotected = false;
  bool may_supervise = false;
};

/// Adds --ros2 and its options. @param group of the help text
/// @param has_network whether programs on other machines may be served
void addRos2Options(CLI::App& command, Ros2Arguments& arguments, const char* group, bool has_network);

/// The domain of the arguments, or of ROS_DOMAIN_ID, or 0. @throws ConfigError
int ros2Domain(const Ros2Arguments& arguments);

}  // namespace robosim
