#pragma once
#include <functional>
#include <vector>

#include "remote/remote_control.h"

namespace robosim {

/// Drives the team's primary robot with a joystick of this machine: for people with a stick and no browser. How it goes
/// is told on standard output: on a terminal as one line that is written over and over, elsewhere as a line a second.
/// @param number of the joystick, 0 for the first
/// @param log takes one line
void driveByJoystick(RemoteControl& control, int number, const std::function<bool()>& interrupted,
                     const std::function<void(const std::string&)>& log);

}  // namespace robosim
