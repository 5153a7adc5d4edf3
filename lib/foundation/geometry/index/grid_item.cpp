#include "geometry/index/grid_item.h"

#include "base/portable_math.h"

namespace robosim {

GridItem GridItem::from(const Solid& solid) {
  GridItem item;
  item.heights = solid.heights;
  if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
    item.x = circle->center.x;
    item.y = circle->center.y;
    item.half_length_m = circle->radius_m;
  } else {
    const auto& box = std::get<OrientedBox>(solid.outline);
    item.x = box.center.x;
    item.y = box.center.y;
    item.axis_x = box.axis.x;
    item.axis_y = box.axis.y;
    item.half_length_m = box.half_length_m;
    item.half_width_m = box.half_width_m;
  }
  return item;
}

Solid GridItem::solid() const {
  if (isCircle()) return {Circle{{x, y}, half_length_m}, heights};
  return {OrientedBox{{x, y}, {axis_x, axis_y}, half_length_m, half_width_m}, heights};
}

double GridItem::reach() const {
  if (isCircle()) return half_length_m;
  // Enlarged slightly, so that rounding never makes a ray through a corner miss the disc.
  return portable::hypot(half_length_m, half_width_m) * (1 + 1e-9);
}

Bounds2D GridItem::bounds() const {
  const double across_m = isCircle() ? half_length_m : half_width_m;
  const double half_x = half_length_m * std::abs(axis_x) + across_m * std::abs(axis_y);
  const double half_y = half_length_m * std::abs(axis_y) + across_m * std::abs(axis_x);
  return {x - half_x, x + half_x, y - half_y, y + half_y};
}

}  // namespace robosim
