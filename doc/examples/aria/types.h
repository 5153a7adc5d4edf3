#pragma once
#include <robosim/run/registry.h>

/// The controller `aria_wander`: drives about, away from obstacles and out of stalls.
robosim::ControllerType wanderType();

/// The controller `aria_teleop`: the arrow keys drive the robot, with speed limits before obstacles.
robosim::ControllerType teleopType();

/// The controller `aria_goto`: drives to the corners of a square, around obstacles.
robosim::ControllerType gotoType();
