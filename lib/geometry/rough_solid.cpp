#include "geometry/rough_solid.h"

namespace robosim {
namespace {

/// A number becomes a float with an error of at most 6e-8 of it; a handful of sums and products of such numbers stay
/// well below this part of the longest length among them.
constexpr double kLoss = 2e-6;
/// More than the rounding of any of these lengths in double precision [m].
constexpr double kSlack_m = 1e-9;

}  // namespace

RoughSolid RoughSolid::from(const GridItem& item, const mrpt::math::TPoint2D& middle) {
  const double x = item.x - middle.x;
  const double y = item.y - middle.y;
  const double lost_m = kLoss * (std::abs(x) + std::abs(y) + item.reach()) + kSlack_m;
  return {static_cast<float>(x),
          static_cast<float>(y),
          static_cast<float>(item.axis_x),
          static_cast<float>(item.axis_y),
          static_cast<float>(item.half_length_m),
          static_cast<float>(item.half_width_m),
          static_cast<float>(item.round_m + lost_m)};
}

RoughPlace RoughPlace::from(const mrpt::math::TPoint2D& place, double spread_m, const mrpt::math::TPoint2D& middle,
                            double room_m) {
  const double x = place.x - middle.x;
  const double y = place.y - middle.y;
  return {static_cast<float>(x), static_cast<float>(y),
          static_cast<float>(kLoss * (std::abs(x) + std::abs(y) + spread_m + room_m) + room_m)};
}

}  // namespace robosim
