#pragma once
#include <mrpt/math/TPoint2D.h>

#include "geometry/shapes/planar_vector.h"

namespace robosim {

/// A measured point of a surface, with the direction in which the surface faces. Frame: as stated where it is used.
struct SurfacePoint {
  mrpt::math::TPoint2D point_m;
  mrpt::math::TPoint2D normal;  ///< unit length, towards the robot
  double std_m = 0.03;          ///< of the distance along the normal
};

}  // namespace robosim
