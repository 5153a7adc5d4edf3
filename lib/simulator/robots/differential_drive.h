#pragma once
#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/path.h"
#include "hardware/command.h"
#include "hardware/robot_info.h"

namespace robosim {

/// Speeds of a differential-drive robot.
struct DriveSpeeds {
  double speed_mps = 0;   ///< forwards
  double turn_radps = 0;  ///< counter-clockwise
};

/// Speeds reached within `period_s` towards a command's target speeds: clamped to the speed limits and limited in
/// acceleration and braking. The robot brakes to a stop before it reverses. The target is 0 if it is not finite, the
/// robot is no longer active, or it makes an emergency stop.
DriveSpeeds reachableSpeeds(const DriveSpeeds& now, const Command& target, const MotionLimits& limits, double period_s);

/// Path of one time step at these speeds.
Path pathOf(const mrpt::math::TPose2D& world_from_robot, const DriveSpeeds& speeds, double period_s);

}  // namespace robosim
