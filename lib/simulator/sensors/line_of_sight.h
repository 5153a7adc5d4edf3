#pragma once
#include <mrpt/math/TPoint3D.h>

#include "geometry/scene.h"

namespace robosim {

/// Whether the first body on the way from one point to another is `seen`, the one that is looked at, or there is none.
/// The body `own` looks, and hides nothing.
bool isInSight(const Scene& scene, const mrpt::math::TPoint3D& from, const mrpt::math::TPoint3D& to, BodyId own,
               BodyId seen);

/// An angle within (-π, π].
double wrapped(double angle_rad);

/// A value as recordings keep it: in single precision.
inline double asFloat(double value) { return static_cast<double>(static_cast<float>(value)); }

}  // namespace robosim
