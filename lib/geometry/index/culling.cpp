#include "geometry/index/culling.h"

namespace robosim {
namespace {

/// More than the rounding of any of these lengths in double precision [m].
constexpr double kSlack_m = 1e-9;

}  // namespace

CullSolid CullSolid::from(const GridItem& item, const mrpt::math::TPoint2D& middle) {
  const double x = item.x - middle.x;
  const double y = item.y - middle.y;
  const double rounding_m = kCullRelativeError * (std::abs(x) + std::abs(y) + item.reach()) + kSlack_m;
  return {static_cast<float>(x),
          static_cast<float>(y),
          static_cast<float>(item.axis_x),
          static_cast<float>(item.axis_y),
          static_cast<float>(item.half_length_m),
          static_cast<float>(item.half_width_m),
          static_cast<float>(item.round_m + rounding_m)};
}

}  // namespace robosim
