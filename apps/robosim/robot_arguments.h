#pragma once
#include <string>
#include <vector>

#include "base/seconds.h"
#include "control/controller_error.h"
#include "net/connect.h"
#include "remote/drive_command_filter.h"
#include "remote/remote_control_robot.h"
#include "remote/remote_port.h"
#include "robosim/connection.h"
#include "robosim/ros2_arguments.h"

namespace CLI {
class App;
}

namespace robosim {

/// Arguments of `robosim robot`.
struct RobotArguments {
  std::vector<std::string> names;
  bool separate_processes = false;
  ConnectionArguments connection;
  std::string controller;
  std::string map;  ///< world file that the controllers know; empty: none
  double reconnect_timeout_s = 10;
  bool joins_next_run = false;
  std::string remote_port;
  ListenerArguments listener;
  double dead_man_s = toSeconds(DriveCommandFilter::kDeadMan);
  std::string arcos;  ///< channel to a robot that speaks ARCOS, as openChannel(); empty: a robot of a served world
  std::string ros2;   ///< namespace of a robot that speaks ROS 2, "/" for none; empty: another robot
  std::vector<std::string> ros2_topics;  ///< "scan=/base_scan"
  Ros2Network ros2_network;
  std::string robot_type;  ///< of a real robot; empty: what a robot that speaks ARCOS reports
  std::string arcos_log;
  std::string laser;                  ///< serial device of an LMS200; empty: none
  bool has_no_laser_request = false;  ///< a simulator of --arcos is not asked for scans
  std::string record;
};

void logRobot(const std::string& line);

/// Options of the port for remote control; requires explicit protection. @throws ConfigError
RemotePort::Options portOptions(const RobotArguments& arguments);
RemoteControlRobot::Options remoteOptions(const RobotArguments& arguments);

/// Calls a function that runs a robot's controller, and replaces the controller's exceptions.
template <typename Step>
void guarded(const std::string& controller_name, const std::string& robot, const Step& step) {
  try {
    step();
  } catch (const ConnectionError&) {
    throw;
  } catch (...) {
    throwControllerError(controller_name, robot);
  }
}

/// @name Real robots: one that speaks ARCOS (arcos_robot.cpp), or ROS 2 (ros2_robot.cpp)
/// They are driven until their controller halts them or Ctrl-C. @throws ConfigError @throws RobotLinkError
///@{
void addArcosRobotOptions(CLI::App& command, RobotArguments& arguments);
void driveArcosRobot(const RobotArguments& arguments);
void addRos2RobotOptions(CLI::App& command, RobotArguments& arguments);
void driveRos2Robot(const RobotArguments& arguments);
///@}

}  // namespace robosim
