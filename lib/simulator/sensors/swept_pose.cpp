#include "sensors/swept_pose.h"

#include <cmath>

#include "base/portable_math.h"

namespace robosim {

template <bool kIsAside>
SweptPoseOf<kIsAside>::SweptPoseOf(const PlanarTransform& now, const Motion& last_motion, double first_share,
                                   double step_share)
    : now_(now),
      length_m_(last_motion.length_m),
      lateral_m_(last_motion.lateral_m),
      diameter_m_(0),
      lateral_diameter_m_(0),
      // Below, the arc deviates from its chord by less than a nanometre per metre.
      is_straight_(std::abs(last_motion.turn_rad) < 1e-9),
      step_share_(step_share) {
  if (!is_straight_) {
    diameter_m_ = 2 * length_m_ / last_motion.turn_rad;
    lateral_diameter_m_ = 2 * lateral_m_ / last_motion.turn_rad;
  }
  const auto half = portable::sincos(last_motion.turn_rad * first_share / 2);
  age_ = {first_share, half.cos, half.sin};
  const auto half_step = portable::sincos(last_motion.turn_rad * step_share / 2);
  half_step_cos_ = half_step.cos;
  half_step_sin_ = half_step.sin;
}

template class SweptPoseOf<false>;
template class SweptPoseOf<true>;

}  // namespace robosim
