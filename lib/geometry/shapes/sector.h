#pragma once
#include <optional>

#include <mrpt/math/TPoint3D.h>

#include "geometry/shapes/solid.h"

namespace robosim {

/// Planar wedge: the points within half_width of the axis about the apex, at the apex's height.
struct Sector {
  mrpt::math::TPoint3D apex;        ///< [m], world frame; z is the height of the wedge
  mrpt::math::TPoint2D axis{1, 0};  ///< unit vector
  mrpt::math::TPoint2D left{1, 0},
      right{1, 0};  ///< unit vectors along the edges, counter-clockwise and clockwise of `axis`

  /// @param axis_rad world frame, CCW from x  @param half_width_rad (0, π/2)
  static Sector towards(const mrpt::math::TPoint3D& apex, double axis_rad, double half_width_rad);
  /// Whether the direction `v` (of any length, from the apex) lies in the wedge, edges included.
  bool contains(const mrpt::math::TPoint2D& v) const;
};

/// Nearest point in a sector.
struct SectorHit {
  double distance_m = 0;
  mrpt::math::TPoint2D point;  ///< world frame [m]
};

/// The exact nearest point to the apex of the solid within the sector; the apex itself when it lies inside the solid;
/// nullopt when the sector and the solid do not intersect, or the apex's height is outside the solid's heights.
std::optional<SectorHit> nearestInSector(const Sector&, const Solid&);

}  // namespace robosim
