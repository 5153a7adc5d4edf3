#pragma once
#include <string>
#include <vector>

#include "remote/map_view.h"
#include "remote/remote_control.h"

namespace robosim {

/// @file
/// What the console tells a page, as JSON (doc/remote_control.md tells the conversation). Lengths are in
/// metres and angles in radians, but ranges in whole millimetres: there are many, and they are short so.

/// What is constant of the robot that is driven.
std::string robotJson(const RobotInfo& robot, double period_s);

/// How the team stands, and who has the wheel.
struct Wheel {
  std::uint64_t holder = 0;  ///< whose the wheel is; 0 for nobody's
  std::string name;
  std::size_t guests = 0;  ///< how many pages there are
};
std::string teamJson(const std::vector<RemoteControl::Robot>& robots, const Wheel& wheel);

/// A step of the robot that is driven; `with_sensors` says whether sonar, laser, infrared and heat are in it.
std::string updateJson(const RobotInfo& robot, const RobotUpdate& update, const RobotPicture* picture,
                       bool with_sensors);
/// One sensor's reading that was asked for.
std::string answerJson(const char* sensor, const RobotAnswer& answer);

std::string mapJson(const MapView& map);
std::string posesJson(const MapView& map);

/// A line for people. @param is_warning whether it deserves to be seen
std::string noteJson(const std::string& text, bool is_warning);

}  // namespace robosim
