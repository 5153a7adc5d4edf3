#include "run/known_world.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr double kKnownCell_m = 0.05;
constexpr double kKnownCellsMax = 4e6;

/// Marks the cells whose centre is within half a cell of an outline.
void occupy(const Outline& outline, KnownWorld& known) {
  const Bounds2D bounds = boundsOf(outline);
  const auto index = [&](double at_m, double low_m, std::size_t count) {
    const double cell = std::floor((at_m - low_m) / known.cell_m);
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
  };
  const double half_m = known.cell_m / 2;
  const std::size_t left = index(bounds.x_min - half_m, known.low.x, known.columns);
  const std::size_t right = index(bounds.x_max + half_m, known.low.x, known.columns);
  const std::size_t top = index(bounds.y_max + half_m, known.low.y, known.rows);
  for (std::size_t y = index(bounds.y_min - half_m, known.low.y, known.rows); y <= top; ++y) {
    for (std::size_t x = left; x <= right; ++x) {
      const std::size_t cell = y * known.columns + x;
      if (distance(outline, known.center(cell)) <= half_m) known.occupied[cell] = 1;
    }
  }
}

}  // namespace

std::shared_ptr<const KnownWorld> makeKnownWorld(const World& world, const Fleet& fleet) {
  auto known = std::make_shared<KnownWorld>();
  const double width_m = world.bounds.x_max - world.bounds.x_min, length_m = world.bounds.y_max - world.bounds.y_min;
  known->low = {world.bounds.x_min, world.bounds.y_min};
  known->cell_m = std::max(kKnownCell_m, std::sqrt(width_m * length_m / kKnownCellsMax));
  const auto count = [&](double extent_m) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(extent_m / known->cell_m)));
  };
  known->columns = count(width_m);
  known->rows = count(length_m);
  known->occupied.resize(known->columns * known->rows);
  HeightSpan heights{0, 0};
  for (const auto& robot : fleet.robots) heights.z_max_m = std::max(heights.z_max_m, robot.info.height_m);
  for (const auto& solid : startSolids(world)) {
    if (solid.heights.overlaps(heights)) occupy(solid.outline, *known);
  }
  for (const auto& object : world.objects) {
    if (object.body.heat_celsius <= 0) continue;
    known->sources.push_back(
        {{object.body.world_from_body.x, object.body.world_from_body.y}, object.body.heat_celsius});
  }
  return known;
}

}  // namespace robosim
