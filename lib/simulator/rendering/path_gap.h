#pragma once
#include <cmath>
#include <limits>

#include <mrpt/math/TPoint2D.h>

namespace robosim {

/// Separates two pieces of a path, between which the way is unknown: the robot was absent, or moved to another place.
inline const mrpt::math::TPoint2D kPathGap{std::numeric_limits<double>::quiet_NaN(),
                                           std::numeric_limits<double>::quiet_NaN()};
inline bool isGap(const mrpt::math::TPoint2D& point) { return std::isnan(point.x); }

}  // namespace robosim
