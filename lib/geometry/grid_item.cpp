#include "geometry/grid_item.h"

namespace robosim {
namespace {

/// A number becomes a float with an error of at most 6e-8 of it; a handful of sums and products of such numbers stay
/// well below this part of the longest length among them.
constexpr double kLoss = 2e-6;
/// More than the rounding of any of these lengths in double precision [m].
constexpr double kSlack_m = 1e-9;

}  // namespace

GridItem GridItem::from(const Solid& solid) {
  GridItem item;
  item.heights = solid.heights;
  if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
    item.is_circle = true;
    item.x = circle->center.x;
    item.y = circle->center.y;
    item.round_m = item.reach_m = circle->radius_m;
  } else {
    const auto& box = std::get<OrientedBox>(solid.outline);
    item.x = box.center.x;
    item.y = box.center.y;
    item.axis_x = box.axis.x;
    item.axis_y = box.axis.y;
    item.half_length_m = box.half_length_m;
    item.half_width_m = box.half_width_m;
    // A little more than it is, so that no rounding makes a ray through a corner seem to pass aside.
    item.reach_m = std::hypot(box.half_length_m, box.half_width_m) * (1 + 1e-9);
  }
  return item;
}

Bounds2D GridItem::bounds() const {
  const double half_x = half_length_m * std::abs(axis_x) + half_width_m * std::abs(axis_y) + round_m;
  const double half_y = half_length_m * std::abs(axis_y) + half_width_m * std::abs(axis_x) + round_m;
  return {x - half_x, x + half_x, y - half_y, y + half_y};
}

RoughSolid RoughSolid::from(const GridItem& item, const mrpt::math::TPoint2D& middle) {
  const double x = item.x - middle.x;
  const double y = item.y - middle.y;
  const double lost_m = kLoss * (std::abs(x) + std::abs(y) + item.reach_m) + kSlack_m;
  return {static_cast<float>(x),
          static_cast<float>(y),
          static_cast<float>(item.axis_x),
          static_cast<float>(item.axis_y),
          static_cast<float>(item.half_length_m),
          static_cast<float>(item.half_width_m),
          static_cast<float>(item.round_m + lost_m)};
}

RoughPlace RoughPlace::from(const mrpt::math::TPoint2D& place, double spread_m, const mrpt::math::TPoint2D& middle) {
  const double x = place.x - middle.x;
  const double y = place.y - middle.y;
  return {static_cast<float>(x), static_cast<float>(y),
          static_cast<float>(kLoss * (std::abs(x) + std::abs(y) + spread_m))};
}

}  // namespace robosim
