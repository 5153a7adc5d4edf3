#pragma once
#include <functional>
#include <vector>

#include "remote/remote_control.h"

namespace robosim {

/// Drives the team's primary robot with a local joystick, without a browser. Prints the state on standard output: on a
/// terminal as one line rewritten in place, otherwise one line per second.
/// @param number of the joystick, 0 for the first
/// @param top_speed fraction of the robot's maximum, (0, 1]
/// @param log receives a line of text
void driveByJoystick(RemoteControl& control, int number, double top_speed, const std::function<bool()>& interrupted,
                     const std::function<void(const std::string&)>& log);

}  // namespace robosim
