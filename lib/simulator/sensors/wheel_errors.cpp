#include "sensors/wheel_errors.h"

#include <cmath>

#include "base/angle_units.h"
#include "base/portable_math.h"

namespace robosim {

WheelErrors WheelErrors::ofRobot(double robot_radius_m, const Drive& drive) {
  WheelErrors e;
  e.drive = drive;
  if (robot_radius_m > 0) e.wheelbase_m = (drive.kind == DriveKind::omni ? 2.5 : 1.25) * robot_radius_m;
  return e;
}

WheelErrors WheelErrors::read(XmlReader& noise, double robot_radius_m, const Drive& drive) {
  WheelErrors e = ofRobot(robot_radius_m, drive);
  e.readErrors(noise);
  if (drive.kind != DriveKind::car) e.wheelbase_m = noise.number("wheelbase_m", Bounds::positive(100), e.wheelbase_m);
  return e;
}

void WheelErrors::readErrors(XmlReader& noise) {
  // Of a car they are read without effect: a type's sensors are also those of robots that a world gives another drive.
  const double ratio = noise.number("diameter_ratio", {0.5, 2}, diameter_ratio);
  const double slip_s = noise.number("turn_slip_s", Bounds::notNegative(10), turn_slip_s);
  if (drive.kind != DriveKind::car) {
    diameter_ratio = ratio;
    turn_slip_s = slip_s;
  }
  wheelbase_ratio = noise.number("wheelbase_ratio", {0.5, 2}, wheelbase_ratio);
  contact_slip = noise.number("contact_slip", Bounds::notNegative(1), contact_slip);
  if (drive.kind == DriveKind::omni) lateral_slip = noise.number("lateral_slip", Bounds::notNegative(1), lateral_slip);
  if (drive.kind == DriveKind::car) steering_offset_rad = noise.angle("steering_offset_deg", {-10, 10}, 0);
}

bool WheelErrors::isNone() const {
  const bool measures_turns = drive.kind == DriveKind::car || (drive.turnShare() == 1 && drive.icr_x_m == 0);
  return diameter_ratio == 1 && wheelbase_ratio == 1 && turn_slip_s == 0 && contact_slip == 0 && lateral_slip == 0 &&
         steering_offset_rad == 0 && measures_turns;
}

Motion WheelErrors::measured(const Motion& true_motion, const Motion& blocked, double period_s) const {
  Motion wheels{true_motion.length_m + contact_slip * blocked.length_m, true_motion.turn_rad,
                true_motion.lateral_m + contact_slip * blocked.lateral_m};
  if (drive.kind == DriveKind::car) {
    wheels.turn_rad += contact_slip * blocked.turn_rad;  // the wheels remain steered
    return measuredByCar(wheels);
  }
  double turn_rad = wheels.turn_rad * (1 + turn_slip_s * std::abs(wheels.turn_rad) / period_s);
  if (drive.kind == DriveKind::tracked) turn_rad /= drive.turnShare();
  // What the wheels travel on the ground, and what that is in turns of the nominal wheels.
  const double aside_m = turn_rad * wheelbase_m * wheelbase_ratio / 2;
  const double right_m = (wheels.length_m + aside_m) * (diameter_ratio + 1) / (2 * diameter_ratio);
  const double left_m = (wheels.length_m - aside_m) * (diameter_ratio + 1) / 2;
  Motion measured{(right_m + left_m) / 2, (right_m - left_m) / wheelbase_m};
  if (drive.kind == DriveKind::omni) {
    // The two wheels of each side turn against each other.
    const double mean_turns = (diameter_ratio + 1) * (diameter_ratio + 1) / (4 * diameter_ratio);
    measured.lateral_m = wheels.lateral_m * (1 + lateral_slip) * mean_turns;
  }
  return measured;
}

Motion WheelErrors::measuredByCar(const Motion& wheels) const {
  if (wheels.length_m == 0) return {};
  const double actual = wheels.turn_rad / wheels.length_m * drive.wheelbase_m * wheelbase_ratio;  // tangent
  const auto [sin, cos] = portable::sincos(steering_offset_rad);
  const double measured = (actual * cos + sin) / (cos - actual * sin);  // tangent of the sum
  const double turn_rad = wheels.length_m * measured / drive.wheelbase_m;
  return {wheels.length_m, turn_rad, -turn_rad * drive.icr_x_m};
}

}  // namespace robosim
