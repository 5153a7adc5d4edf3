#pragma once
#include <mrpt/math/TPoint2D.h>

namespace robosim {

inline double dot(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) { return a.x * b.x + a.y * b.y; }
/// The z component of the cross product.
inline double cross(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) { return a.x * b.y - a.y * b.x; }
/// The vector turned by a quarter, counter-clockwise.
inline mrpt::math::TPoint2D turnedLeft(const mrpt::math::TPoint2D& v) { return {-v.y, v.x}; }

inline bool isWithin(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b, double far_m) {
  const mrpt::math::TPoint2D way = a - b;
  return dot(way, way) <= far_m * far_m;
}

}  // namespace robosim
