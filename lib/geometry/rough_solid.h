#pragma once
#include <cmath>

#include "geometry/grid_item.h"

namespace robosim {

/// A number becomes a float with an error of at most 6e-8 of it; a handful of sums and products of such numbers stay
/// well below this part of the longest length among them.
constexpr double kRoughLoss = 2e-6;

/// A solid in single precision, as seen from the middle of its scene: enough to tell who may meet it. `round_m` has
/// room for what single precision loses, so that nobody who meets the solid misses this one.
struct RoughSolid {
  float x = 0, y = 0, axis_x = 1, axis_y = 0;
  float half_length_m = 0, half_width_m = 0, round_m = 0;

  static RoughSolid from(const GridItem&, const mrpt::math::TPoint2D& middle);
  /// Radius [m] of a disc about its centre that covers it.
  float reach() const { return half_length_m + half_width_m + round_m; }
};

/// A place in the same way, from which someone looks.
struct RoughPlace {
  float x = 0, y = 0;
  float lost_m = 0;  ///< room for what single precision loses of the place

  /// @param spread_m how far around the place the looking starts
  /// @param room_m more to add
  static RoughPlace from(const mrpt::math::TPoint2D& place, double spread_m, const mrpt::math::TPoint2D& middle,
                         double room_m = 0) {
    const double x = place.x - middle.x;
    const double y = place.y - middle.y;
    return {static_cast<float>(x), static_cast<float>(y),
            static_cast<float>(kRoughLoss * (std::abs(x) + std::abs(y) + spread_m + room_m) + room_m)};
  }
};

}  // namespace robosim
