#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dds/participant.h"
#include "robosim/cli11_names.h"

namespace robosim {

/// Where programs of ROS 2 are.
struct Ros2Network {
  std::optional<int> domain;  ///< nullopt: ROS_DOMAIN_ID, or 0
  std::string interface;
  std::vector<std::string> peers;
};

/// Arguments of --ros2 and the options that belong to it.
struct Ros2Arguments {
  bool is_on = false;
  Ros2Network network;
  std::string name_space;
  std::string trees = "common";  ///< of frames: "common" or "robot"
  bool is_unprotected = false;
  bool may_supervise = false;
};

/// Adds --ros2 and its options. @param group of the help text
/// @param has_network whether programs on other machines may be served
void addRos2Options(CLI::App& command, Ros2Arguments& arguments, const char* group, bool has_network);

/// Adds --domain, and for other machines --ros2-interface and --ros2-peer. @param ros2 --ros2, without which they have
/// no effect
void addRos2NetworkOptions(CLI::App& command, Ros2Network& network, const CLI::Option* ros2, const char* group,
                           bool has_network);

/// The same for joining the domain. @param log takes one line; thread-safe @throws ConfigError for a false
/// ROS_DOMAIN_ID
dds::Options ddsOptions(const Ros2Network& network, const std::function<void(const std::string&)>& log);

}  // namespace robosim
