#pragma once
#include "geometry/grid_item.h"

namespace robosim {

/// A solid in single precision, as seen from the middle of its scene: enough to tell who may meet it. `round_m` has
/// room for what single precision loses, so that nobody who meets the solid misses this one.
struct RoughSolid {
  float x = 0, y = 0, axis_x = 1, axis_y = 0;
  float half_length_m = 0, half_width_m = 0, round_m = 0;

  static RoughSolid from(const GridItem&, const mrpt::math::TPoint2D& middle);
};

/// A place in the same way, from which someone looks.
struct RoughPlace {
  float x = 0, y = 0;
  float lost_m = 0;  ///< room for what single precision loses of the place

  /// @param spread_m how far around the place the looking starts
  /// @param room_m more to add
  static RoughPlace from(const mrpt::math::TPoint2D& place, double spread_m, const mrpt::math::TPoint2D& middle,
                         double room_m = 0);
};

}  // namespace robosim
