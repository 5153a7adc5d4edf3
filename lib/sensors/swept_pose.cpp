#include "sensors/swept_pose.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {

SweptPose::SweptPose(const PlanarTransform& now, const Motion& last_motion, double first_share, double step_share)
    : now_(now),
      length_m_(last_motion.length_m),
      diameter_m_(0),
      // Below, the arc deviates from its chord by less than a nanometre per metre.
      is_straight_(std::abs(last_motion.turn_rad) < 1e-9),
      share_(first_share),
      step_share_(step_share) {
  if (!is_straight_) diameter_m_ = 2 * length_m_ / last_motion.turn_rad;
  const auto half = portable::sincos(last_motion.turn_rad * first_share / 2);
  half_cos_ = half.cos;
  half_sin_ = half.sin;
  const auto half_step = portable::sincos(last_motion.turn_rad * step_share / 2);
  half_step_cos_ = half_step.cos;
  half_step_sin_ = half_step.sin;
  place();
}

void SweptPose::next() {
  share_ -= step_share_;
  const double cos = half_cos_ * half_step_cos_ + half_sin_ * half_step_sin_;
  half_sin_ = half_sin_ * half_step_cos_ - half_cos_ * half_step_sin_;
  half_cos_ = cos;
  place();
}

void SweptPose::place() {
  // The chord of an arc has the direction of its middle.
  const double chord_m = is_straight_ ? length_m_ * share_ : diameter_m_ * half_sin_;
  x_ = -chord_m * half_cos_;
  y_ = chord_m * half_sin_;
  cos_ = half_cos_ * half_cos_ - half_sin_ * half_sin_;
  sin_ = -2 * half_sin_ * half_cos_;
}

mrpt::math::TPoint3D SweptPose::pointToWorld(const mrpt::math::TPoint3D& p) const {
  return now_.pointToWorld(mrpt::math::TPoint3D(x_ + cos_ * p.x - sin_ * p.y, y_ + sin_ * p.x + cos_ * p.y, p.z));
}

mrpt::math::TPoint3D SweptPose::turnToWorld(const mrpt::math::TPoint3D& v) const {
  return now_.turnToWorld(mrpt::math::TPoint3D(cos_ * v.x - sin_ * v.y, sin_ * v.x + cos_ * v.y, v.z));
}

}  // namespace robosim
