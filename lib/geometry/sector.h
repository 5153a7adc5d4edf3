#pragma once
#include <optional>

#include <mrpt/math/TPoint3D.h>

#include "geometry/solid.h"

namespace robosim {

/// A level wedge: the points within `half_width_rad` of the axis as seen from the apex.
struct Sector {
  mrpt::math::TPoint3D apex;   ///< [m], world frame; z is the height at which it looks
  double axis_rad = 0;         ///< world frame, CCW from x
  double half_width_rad = 0;   ///< (0, π/2)
};

/// The nearest thing in a sector.
struct SectorHit {
  double distance_m = 0;
  mrpt::math::TPoint2D point;  ///< world frame [m]
};

/// The point of the solid within the sector that is nearest to the apex, exactly; the apex itself when it lies inside the
/// solid; nullopt when the sector holds no part of it or looks over or under it.
std::optional<SectorHit> nearestInSector(const Sector&, const Solid&);

}  // namespace robosim
