#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>

#include "base/portable_math.h"

namespace robosim {

/// Planar wedge: the points within half_width of the axis about the apex, at the apex's height.
struct Sector {
  mrpt::math::TPoint3D apex;        ///< [m], world frame; z is the height of the wedge
  mrpt::math::TPoint2D axis{1, 0};  ///< unit vector
  mrpt::math::TPoint2D left{1, 0},
      right{1, 0};  ///< unit vectors along the edges, counter-clockwise and clockwise of `axis`

  /// @param axis_rad world frame, CCW from x  @param half_width_rad (0, π/2)
  static Sector towards(const mrpt::math::TPoint3D& apex, double axis_rad, double half_width_rad) {
    const auto unit = [](double angle_rad) {
      const auto [sin, cos] = portable::sincos(angle_rad);
      return mrpt::math::TPoint2D(cos, sin);
    };
    return {apex, unit(axis_rad), unit(axis_rad + half_width_rad), unit(axis_rad - half_width_rad)};
  }
  /// Whether the direction `v` (of any length, from the apex) lies in the wedge, edges included.
  bool contains(const mrpt::math::TPoint2D& v) const {
    return right.x * v.y - right.y * v.x >= 0 && v.x * left.y - v.y * left.x >= 0;
  }
};

}  // namespace robosim
