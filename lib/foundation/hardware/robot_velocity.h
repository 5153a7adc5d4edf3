#pragma once
#include <mrpt/math/TPose2D.h>

namespace robosim {

/// Velocity of a robot in its own frame: the mean of a step, in which it drove an arc.
struct RobotVelocity {
  double speed_mps = 0;    ///< forwards, along the arc
  double turn_radps = 0;   ///< counter-clockwise
  double lateral_mps = 0;  ///< to the left
  bool operator==(const RobotVelocity&) const = default;
};

/// The velocity that leads from a pose to the next one, within half a turn. @param period_s length of the step, > 0
RobotVelocity velocityBetween(const mrpt::math::TPose2D& from, const mrpt::math::TPose2D& to, double period_s);

}  // namespace robosim
