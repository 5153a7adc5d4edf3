#pragma once
#include <string>

#include "hardware/real_robot.h"
#include "robosim/robot_arguments.h"
#include "robots/fleet.h"

namespace robosim {

/// The group of the options for real robots in the help of `robosim robot`.
inline constexpr const char* kRealRobotGroup = "A real robot";

/// A robot of a type of the folders robots/. @throws ConfigError when there is none
FleetRobot robotTypeNamed(const std::string& name);

/// @param option "--arcos" @throws ConfigError for more than one name, and without a controller
void checkRealRobotArguments(const std::string& option, const RobotArguments& arguments);

/// Drives a robot by its controller or by remote control, and records it, until its controller halts it or the program
/// is interrupted. @param where address of the robot
/// @throws ConfigError @throws RobotLinkError
void driveRealRobot(RealRobot& robot, const std::string& where, const RobotArguments& arguments);

}  // namespace robosim
