#pragma once
#include <mrpt/math/TPose2D.h>

#include "geometry/path.h"
#include "hardware/command.h"
#include "hardware/robot_info.h"

namespace robosim {

/// Speeds of a robot with two driven wheels.
struct DriveSpeeds {
  double speed_mps = 0;   ///< ahead
  double turn_radps = 0;  ///< counter-clockwise
};

/// The speeds that a robot reaches within `period_s` when it wishes for a command's: within its limits on speed, and no
/// further from its present speeds than it can accelerate or brake. It brakes to a stand before it reverses. A wish
/// that is not finite, or comes from a robot that is no longer active, counts as 0.
DriveSpeeds reachableSpeeds(const DriveSpeeds& now, const Command& wish, const MotionLimits& limits, double period_s);

/// The way of one time step at these speeds.
Path pathOf(const mrpt::math::TPose2D& world_from_robot, const DriveSpeeds& speeds, double period_s);

}  // namespace robosim
