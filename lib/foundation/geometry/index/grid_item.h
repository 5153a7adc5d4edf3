#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/shapes/solid.h"

namespace robosim {

/// Solid as stored by the indices of a scene: one cache line. A circle has no width, and its radius as half length.
struct alignas(64) GridItem {
  double x = 0, y = 0;            ///< centre [m]
  double axis_x = 1, axis_y = 0;  ///< unit vector along the box's length
  double half_length_m = 0;       ///< or a circle's radius
  double half_width_m = 0;        ///< 0 for a circle
  HeightSpan heights;

  static GridItem from(const Solid&);
  /// An item that no query finds.
  static GridItem removed() {
    GridItem item;
    item.x = std::numeric_limits<double>::quiet_NaN();
    return item;
  }
  bool isRemoved() const { return std::isnan(x); }
  Solid solid() const;
  bool isCircle() const { return half_width_m == 0; }
  /// Radius [m] of the covering disc about its centre.
  double reach() const;
  Bounds2D bounds() const;
  /// Distance [m] from a point to the filled outline; 0 inside.
  double distanceTo(const mrpt::math::TPoint2D& p) const {
    const double ox = p.x - x;
    const double oy = p.y - y;
    const double round_m = isCircle() ? half_length_m : 0;
    const double beyond_a = std::max(0.0, std::abs(ox * axis_x + oy * axis_y) - (half_length_m - round_m));
    const double beyond_b = std::max(0.0, std::abs(oy * axis_x - ox * axis_y) - half_width_m);
    return std::max(0.0, std::sqrt(beyond_a * beyond_a + beyond_b * beyond_b) - round_m);
  }
};

}  // namespace robosim
