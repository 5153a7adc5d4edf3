#pragma once
#include <optional>

#include <mrpt/math/TPoint3D.h>

#include "geometry/solid.h"

namespace robosim {

/// A ray in the world frame, from `origin` along the unit vector `direction`. A level ray has direction.z == 0.
struct Ray {
  mrpt::math::TPoint3D origin;     ///< [m]
  mrpt::math::TPoint3D direction;  ///< |direction| = 1

  /// From a point towards `azimuth_rad` about z (CCW from x) and `elevation_rad` above the horizontal.
  static Ray towards(const mrpt::math::TPoint3D& origin, double azimuth_rad, double elevation_rad = 0);
  mrpt::math::TPoint3D at(double distance_m) const { return origin + direction * distance_m; }
};

/// Distance [m] along the ray to where it enters the solid: 0 from inside, nullopt when it misses. A ray that only
/// touches (a tangent, a corner, along a face) hits.
std::optional<double> intersect(const Ray&, const Solid&);

}  // namespace robosim
