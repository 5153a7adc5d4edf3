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

/// Part of a ray: distances [m] along it, from_m <= to_m. A part that begins behind the ray's origin has from_m < 0.
struct RaySpan {
  double from_m = 0, to_m = 0;
};
/// The part of the line of a ray that lies inside the solid, also behind the origin; nullopt for a miss. A point of
/// contact is a part of length 0. A vertical line inside the solid has the part between its underside and top.
std::optional<RaySpan> spanInside(const Ray&, const Solid&);

}  // namespace robosim
