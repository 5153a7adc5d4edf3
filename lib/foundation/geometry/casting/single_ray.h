#pragma once
#include <cmath>
#include <limits>

#include "geometry/casting/double_pair.h"
#include "geometry/index/grid_index.h"
#include "geometry/shapes/ray_intersection.h"

namespace robosim {

/// intersectCircle() or intersectBox() of ray_intersection.h for a single ray. The item's shape is an unpredictable
/// branch, so both are computed and one is selected; pairs of equal operations share one vector. The operations are the
/// same, so the results are bit-identical.
/// @param origin,direction of the ray; direction is a unit vector
[[gnu::always_inline]] inline double intersectItem(const GridItem& item, const DoublePair& origin,
                                                   const DoublePair& direction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const DoublePair turned{1, -1};
  const DoublePair zero{};
  const DoublePair out = DoublePair{item.x, item.y} - origin;

  // The ray in the box's frame, and its interval between each pair of faces (slab method).
  const DoublePair axis_y = broadcast(item.axis_y) * turned;
  const DoublePair at = -(out * item.axis_x + swapped(out) * axis_y);
  const DoublePair slope = direction * item.axis_x + swapped(direction) * axis_y;
  const DoublePair half{item.half_length_m, item.half_width_m};
  const DoublePair per = 1 / (slope == zero ? broadcast(kMinFaceSlope) : slope);
  const DoublePair one = (-half - at - kMinFaceGap_m) * per;
  const DoublePair other = (half - at + kMinFaceGap_m) * per;
  const DoublePair begin = min(one, other);
  const DoublePair end = max(one, other);
  const DoublePair from = max(max(begin, swapped(begin)), zero);
  const DoublePair to = min(end, swapped(end));
  const DoublePair box = from <= to ? from : broadcast(kInfinity);

  const DoublePair along_across = broadcast(direction[0]) * out + broadcast(direction[1]) * turned * swapped(out);
  const double along = along_across[0];
  const double across = along_across[1];
  const double half_chord =
      std::sqrt(item.half_length_m * item.half_length_m - across * across);  // NaN when the ray misses
  const DoublePair near = max(DoublePair{along - half_chord, 0}, zero);
  const DoublePair far{along + half_chord, 0};
  const DoublePair circle = far >= zero ? near : broadcast(kInfinity);
  return (DoublePair{item.half_width_m, 0} > zero ? box : circle)[0];
}

}  // namespace robosim
