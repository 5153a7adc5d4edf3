#include "hardware/robot_velocity.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {

RobotVelocity velocityBetween(const mrpt::math::TPose2D& from, const mrpt::math::TPose2D& to, double period_s) {
  const double turn_rad = std::remainder(to.phi - from.phi, 2 * M_PI);
  // In the frame of the middle of an arc, its chord has the direction of the velocity.
  const double middle_rad = from.phi + turn_rad / 2;
  const auto [sin, cos] = portable::sincos(middle_rad);
  const double ahead_m = (to.x - from.x) * cos + (to.y - from.y) * sin;
  const double left_m = (to.y - from.y) * cos - (to.x - from.x) * sin;
  const double half_rad = turn_rad / 2;
  const double arc_by_chord = std::abs(half_rad) < 1e-9 ? 1 : half_rad / portable::sin(half_rad);
  return {ahead_m * arc_by_chord / period_s, turn_rad / period_s, left_m * arc_by_chord / period_s};
}

}  // namespace robosim
