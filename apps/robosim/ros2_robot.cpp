#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/dds_library.h"
#include "robosim/real_robot.h"
#include "robosim/robot_arguments.h"
#include "ros2/ros2_hardware.h"

namespace robosim {
namespace {

/// "/robot1" of "robot1" or "/robot1/"; empty of "/". @throws ConfigError for what is no namespace of ROS
std::string prefixOf(const std::string& name) {
  std::string prefix = name.starts_with('/') ? name : '/' + name;
  while (prefix.ends_with('/')) prefix.pop_back();
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/';
  };
  if (!std::all_of(prefix.begin(), prefix.end(), is_allowed) || prefix.find("//") != std::string::npos) {
    throw ConfigError("--ros2 " + name + ": must be the robot's namespace, as in /robot1, or / for none");
  }
  return prefix;
}

/// Names of topics: "scan=/base_scan". @throws ConfigError
std::map<std::string, std::string> topicsOf(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> topics;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size() || text[equals + 1] != '/') {
      throw ConfigError("--ros2-topic " + text +
                        ": must be the name below the namespace and the whole name of the robot's topic, as in "
                        "scan=/robot1/base_scan");
    }
    topics[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return topics;
}

Ros2Hardware::Options ros2HardwareOptions(const RobotArguments& arguments, int domain, const Interrupt& interrupt) {
  Ros2Hardware::Options options;
  options.prefix = prefixOf(arguments.ros2);
  options.type = robotTypeNamed(arguments.robot_type).info;
  if (!arguments.names.empty()) {
    options.name = arguments.names.front();
  } else if (!options.prefix.empty()) {
    options.name = options.prefix.substr(options.prefix.rfind('/') + 1);
  }
  options.topics = topicsOf(arguments.ros2_topics);
  options.where = "domain " + std::to_string(domain);
  options.log = logRobot;
  options.interrupted = [&interrupt] { return interrupt.isRequested(); };
  return options;
}

}  // namespace

void addRos2RobotOptions(CLI::App& command, RobotArguments& arguments) {
  command
      .add_option("--ros2", arguments.ros2,
                  "drive a robot that speaks ROS 2 with the controller of --controller: its namespace, as in /robot1, "
                  "or / for none. Its sensors and limits are those of --robot-type, as far as it has them")
      ->type_name("NAMESPACE")
      ->group(kRealRobotGroup)
      ->excludes("--arcos");
  const CLI::Option* ros2 = command.get_option("--ros2");
  command
      .add_option("--ros2-topic", arguments.ros2_topics,
                  "name of a topic that is not the usual one below the namespace, as in scan=/robot1/base_scan; "
                  "repeatable")
      ->type_name("NAME=TOPIC")
      ->allow_extra_args(false)
      ->group(kRealRobotGroup);
  dependsOn(command.get_option("--ros2-topic"), ros2);
  addRos2NetworkOptions(command, arguments.ros2_network, ros2, kRealRobotGroup, true);
}

void driveRos2Robot(const RobotArguments& arguments) {
  checkRealRobotArguments("--ros2", arguments);
  if (arguments.robot_type.empty()) {
    throw ConfigError(
        "--ros2 needs --robot-type, of which the limits and the places of sensors are, as in "
        "--robot-type p3dx; the types are the files of worlds/robots/");
  }
  const Interrupt interrupt;
  const dds::Options dds = ddsOptions(arguments.ros2_network, logRobot);
  const std::shared_ptr<dds::Participant> participant = joinDds(dds);
  Ros2Hardware robot(participant, ros2HardwareOptions(arguments, dds.domain, interrupt));
  driveRealRobot(robot, "ros2:" + arguments.ros2, arguments);
}

}  // namespace robosim
