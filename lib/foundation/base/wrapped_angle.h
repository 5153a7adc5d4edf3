#pragma once
#include <cmath>

#include <mrpt/math/wrap2pi.h>

namespace robosim {

/// The same, bit for bit, as mrpt::math::wrapToPi(), which divides even where nothing is to be wrapped.
inline double wrappedAngle(double angle_rad) {
  const double turned_rad = angle_rad + M_PI;
  if (turned_rad >= 0 && turned_rad < 2 * M_PI) return turned_rad - M_PI;
  return mrpt::math::wrapToPi(angle_rad);
}

}  // namespace robosim
