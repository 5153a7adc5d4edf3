#pragma once
#include <optional>

#include <mrpt/math/TPoint3D.h>

#include "geometry/solid.h"

namespace robosim {

/// A level wedge: the points within half_width of the axis as seen from the apex, at the apex's height.
struct Sector {
  mrpt::math::TPoint3D apex;        ///< [m], world frame; z is the height at which it looks
  mrpt::math::TPoint2D axis{1, 0};  ///< unit vector
  mrpt::math::TPoint2D left{1, 0},
      right{1, 0};  ///< unit vectors along the edges, counter-clockwise and clockwise of `axis`

  /// @param axis_rad world frame, CCW from x  @param half_width_rad (0, π/2)
  static Sector towards(const mrpt::math::TPoint3D& apex, double axis_rad, double half_width_rad);
  /// Whether the direction `v` (of any length, from the apex) lies in the wedge, edges included.
  bool holds(const mrpt::math::TPoint2D& v) const;
};

/// The nearest thing in a sector.
struct SectorHit {
  double distance_m = 0;
  mrpt::math::TPoint2D point;  ///< world frame [m]
};

/// The point of the solid within the sector that is nearest to the apex, exactly; the apex itself when it lies inside
/// the solid; nullopt when the sector holds no part of it or looks over or under it.
std::optional<SectorHit> nearestInSector(const Sector&, const Solid&);

}  // namespace robosim
