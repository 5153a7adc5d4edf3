#pragma once
#include <optional>

#include <mrpt/math/TPoint3D.h>

#include "geometry/shapes/solid.h"

namespace robosim {

/// Ray in the world frame, from `origin` along the unit vector `direction`. A planar ray has direction.z == 0.
struct Ray {
  mrpt::math::TPoint3D origin;     ///< [m]
  mrpt::math::TPoint3D direction;  ///< |direction| = 1

  /// Ray from a point with the given azimuth about z (CCW from x) and elevation above the horizontal.
  static Ray towards(const mrpt::math::TPoint3D& origin, double azimuth_rad, double elevation_rad = 0);
  mrpt::math::TPoint3D at(double distance_m) const { return origin + direction * distance_m; }
};

/// Distance [m] along the ray to its entry into the solid: 0 from inside, nullopt for a miss. A ray that only touches
/// (tangent, corner, along a face) hits.
std::optional<double> intersect(const Ray&, const Solid&);

}  // namespace robosim
