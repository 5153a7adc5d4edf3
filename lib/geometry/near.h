#pragma once
#include <algorithm>
#include <limits>

#include <mrpt/math/TPoint2D.h>

#include "geometry/rough_solid.h"

namespace robosim {

/// What lies within a distance of a place, in single precision.
class Near {
 public:
  /// @param reach_m at least 0
  Near(const mrpt::math::TPoint2D& place, double reach_m, const mrpt::math::TPoint2D& middle)
      : at_(place),
        reach_m_(std::min(reach_m, double{std::numeric_limits<float>::max()})),
        place_(RoughPlace::from(place, reach_m_, middle)),
        far_m_(static_cast<float>(reach_m_) + place_.lost_m) {}

  Bounds2D bounds() const { return {at_.x - reach_m_, at_.x + reach_m_, at_.y - reach_m_, at_.y + reach_m_}; }
  bool mayHold(const RoughSolid& solid) const {
    const float dx = solid.x - place_.x;
    const float dy = solid.y - place_.y;
    const float far_m = far_m_ + solid.reach();
    return dx * dx + dy * dy <= far_m * far_m;
  }

 private:
  mrpt::math::TPoint2D at_;
  double reach_m_;
  RoughPlace place_;
  float far_m_;
};

}  // namespace robosim
