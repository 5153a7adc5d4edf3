#pragma once
#include <array>

#include <mrpt/math/TPoint2D.h>

#include "geometry/shapes/solid.h"

namespace robosim {

/// Where two outlines touch or are nearest to each other.
struct Contact {
  mrpt::math::TPoint2D normal;  ///< unit vector from the first outline to the second
  struct Point {
    mrpt::math::TPoint2D at;
    double gap_m = 0;  ///< along the normal; negative where they overlap
  };
  std::array<Point, 2> points;
  int count = 1;  ///< 2 where a side of one box faces one of another

  /// Negative exactly when the outlines overlap; otherwise near their distance.
  double gap() const { return count == 2 && points[1].gap_m < points[0].gap_m ? points[1].gap_m : points[0].gap_m; }
};

/// The contact of two outlines. Each of two boxes has a side that faces the other: the one with the largest gap
/// (Gottschalk, Lin & Manocha, "OBBTree", SIGGRAPH 1996); the contact is the part of the other's side that lies in
/// front of it.
Contact contactOf(const Outline& a, const Outline& b);

}  // namespace robosim
