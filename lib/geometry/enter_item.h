#pragma once
#include <cmath>
#include <limits>

#include "geometry/grid_item.h"
#include "geometry/level_ray.h"
#include "geometry/two.h"

namespace robosim {

/// enterCircle() or enterBox() of level_ray.h, whichever the item is, for one ray: both are worked out, as which it is
/// is anybody's guess, and those of two numbers that are worked out alike lie in one vector. The same sums, so the same
/// bits.
/// @param origin,direction of the ray; a unit vector
[[gnu::always_inline]] inline double enterItem(const GridItem& item, const Two& origin, const Two& direction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Two turned{1, -1};
  const Two zero{};
  const Two out = Two{item.x, item.y} - origin;

  // The ray in the box's own frame, and the stretch of it between each pair of faces.
  const Two axis_y = both(item.axis_y) * turned;
  const Two at = -(out * item.axis_x + swapped(out) * axis_y);
  const Two slope = direction * item.axis_x + swapped(direction) * axis_y;
  const Two half{item.half_length_m, item.half_width_m};
  const Two per = 1 / (slope == zero ? both(kLeastFaceSlope) : slope);
  const Two one = (-half - at - kLeastFaceGap_m) * per;
  const Two other = (half - at + kLeastFaceGap_m) * per;
  const Two begin = least(one, other);
  const Two end = most(one, other);
  const Two from = most(most(begin, swapped(begin)), zero);
  const Two to = least(end, swapped(end));
  const Two box = from <= to ? from : both(kInfinity);

  const Two along_across = both(direction[0]) * out + both(direction[1]) * turned * swapped(out);
  const double along = along_across[0];
  const double across = along_across[1];
  const double half_chord = std::sqrt(item.round_m * item.round_m - across * across);  // no number where it passes
  const Two near = most(Two{along - half_chord, 0}, zero);
  const Two far{along + half_chord, 0};
  const Two circle = far >= zero ? near : both(kInfinity);
  return (Two{item.round_m, 0} > zero ? circle : box)[0];
}

}  // namespace robosim
