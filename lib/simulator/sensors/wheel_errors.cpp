#include "sensors/wheel_errors.h"

#include <cmath>

namespace robosim {

WheelErrors WheelErrors::read(XmlReader& noise, double robot_radius_m) {
  WheelErrors e;
  if (robot_radius_m > 0) e.wheelbase_m = 1.25 * robot_radius_m;
  e.diameter_ratio = noise.number("diameter_ratio", {0.5, 2}, e.diameter_ratio);
  e.wheelbase_ratio = noise.number("wheelbase_ratio", {0.5, 2}, e.wheelbase_ratio);
  e.wheelbase_m = noise.number("wheelbase_m", Bounds::positive(100), e.wheelbase_m);
  e.turn_slip_s = noise.number("turn_slip_s", Bounds::notNegative(10), e.turn_slip_s);
  e.contact_slip = noise.number("contact_slip", Bounds::notNegative(1), e.contact_slip);
  return e;
}

Motion WheelErrors::measured(const Motion& true_motion, double blocked_m, double period_s) const {
  const double length_m = true_motion.length_m + contact_slip * blocked_m;
  const double turn_rad = true_motion.turn_rad * (1 + turn_slip_s * std::abs(true_motion.turn_rad) / period_s);
  // What the wheels travel on the ground, and what that is in turns of the nominal wheels.
  const double aside_m = turn_rad * wheelbase_m * wheelbase_ratio / 2;
  const double right_m = (length_m + aside_m) * (diameter_ratio + 1) / (2 * diameter_ratio);
  const double left_m = (length_m - aside_m) * (diameter_ratio + 1) / 2;
  return {(right_m + left_m) / 2, (right_m - left_m) / wheelbase_m};
}

}  // namespace robosim
