#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/shapes/solid.h"

namespace robosim {

/// Solid as stored by the indices of a scene, contiguous in memory. Represents a box, or a circle as a box of zero size
/// with radius `round_m`, so that most queries use one formula for both.
struct GridItem {
  double x = 0, y = 0;            ///< centre [m]
  double axis_x = 1, axis_y = 0;  ///< unit vector along the box's length
  double half_length_m = 0;
  double half_width_m = 0;
  double round_m = 0;  ///< radius of a circle; 0 for a box
  HeightSpan heights;
  std::uint32_t number = 0;  ///< position in the order given to the index

  static GridItem from(const Solid&, std::uint32_t number);
  Solid solid() const;
  bool isCircle() const { return round_m > 0; }
  /// Radius [m] of the covering disc about its centre.
  double reach() const;
  Bounds2D bounds() const;
  /// Distance [m] from a point to the filled outline; 0 inside.
  double distanceTo(const mrpt::math::TPoint2D& p) const { return std::max(0.0, std::sqrt(squaredToBox(p)) - round_m); }

 private:
  double squaredToBox(const mrpt::math::TPoint2D& p) const {
    const double ox = p.x - x;
    const double oy = p.y - y;
    const double beyond_a = std::max(0.0, std::abs(ox * axis_x + oy * axis_y) - half_length_m);
    const double beyond_b = std::max(0.0, std::abs(oy * axis_x - ox * axis_y) - half_width_m);
    return beyond_a * beyond_a + beyond_b * beyond_b;
  }
};

}  // namespace robosim
