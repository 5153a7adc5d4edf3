#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/enter_item.h"
#include "geometry/grid_walk.h"
#include "geometry/nearest_so_far.h"
#include "geometry/rough_ray.h"
#include "geometry/vector_clones.h"

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a ray met, if anything, from how far it went.
inline Hit complete(const Ray& ray, const NearestSoFar& met) {
  return {met.body != kNoBody ? met.distance_m : kInfinity, met.body, ray.at(met.distance_m)};
}

}  // namespace

ROBOSIM_VECTOR_CLONES
Hit Scene::castRay(const Ray& ray, double range_m, BodyId except) const {
  const Two origin{ray.origin.x, ray.origin.y};
  const Two direction{ray.direction.x, ray.direction.y};
  const GridIndex& grid = stationary_index_;
  const Two in_cells = grid.inCells(origin);
  if (ray.direction.z != 0 || !grid.holds(in_cells)) [[unlikely]]
    return castAnyRay(ray, range_m, except);

  GridWalk walk(grid, in_cells, direction);
  const Two from = origin - Two{grid.middle().x, grid.middle().y};
  const RoughRay rough{static_cast<float>(from[0]), static_cast<float>(from[1]), static_cast<float>(direction[0]),
                       static_cast<float>(direction[1])};
  walk.setReach(std::max(range_m, 0.0));
  NearestSoFar best{range_m};
  auto reach_m = static_cast<float>(range_m);
  for (const CellPack* pack = walk.pack();;) {
    std::uint32_t passed = rough.passed(*pack, grid.rectanglesOf(pack), reach_m);
    if (passed != 0) {
      for (; passed != 0; passed &= passed - 1) {
        const std::uint32_t index = pack->index[std::countr_zero(passed)];
        assert(index < grid.items().size());
        const GridItem& item = grid.items()[index];
        const double met_m = enterItem(item, origin, direction);
        if (item.heights.contains(ray.origin.z)) best.keepBetter(met_m, BodyId{item.number}, except);
      }
      walk.setReach(best.distance_m);
      reach_m = static_cast<float>(best.distance_m);
    }
    if (pack->goesOn()) [[unlikely]] {
      pack = &grid.packs()[pack->next()];
      continue;
    }
    if (!walk.goOn()) break;
    pack = walk.pack();
  }
  if (!grid.holdsAll() && walk.leavesWithin(best.distance_m)) [[unlikely]]
    return castAnyRay(ray, range_m, except);
  if (movingCount() > 0) return castAmongMoving(ray, except, best);
  return complete(ray, best);
}

Hit Scene::castAnyRay(const Ray& ray, double range_m, BodyId except) const {
  NearestSoFar best{range_m};
  const auto reach = [&] { return best.distance_m; };
  const auto cast = [&](BodyId body) {
    best.keepBetter(intersect(ray, solid(body)).value_or(kInfinity), body, except);
  };
  stationary_index_.visitAlong(ray, reach, [&](std::uint32_t i) { cast(stationaryBody(i)); });
  moving_index_.visitAlong(ray, reach, [&](const CenterIndex::Entry& entry) { cast(movingBody(entry.index)); });
  return complete(ray, best);
}

Hit Scene::castAmongMoving(const Ray& ray, BodyId except, NearestSoFar best) const {
  const Two origin{ray.origin.x, ray.origin.y};
  const Two direction{ray.direction.x, ray.direction.y};
  const auto reach = [&] { return best.distance_m; };
  const auto from = RoughPlace::from({ray.origin.x, ray.origin.y}, 0, moving_index_.middle());
  const auto dx = static_cast<float>(ray.direction.x);
  const auto dy = static_cast<float>(ray.direction.y);
  moving_index_.visitAlong(ray, reach, [&](const CenterIndex::Entry& entry) {
    const float across = dx * (entry.solid.y - from.y) - dy * (entry.solid.x - from.x);
    if (std::abs(across) > entry.solid.reach() + from.lost_m) return;
    const GridItem& item = moving_index_.items()[entry.index];
    if (!item.heights.contains(ray.origin.z)) return;
    best.keepBetter(enterItem(item, origin, direction), movingBody(entry.index), except);
  });
  return complete(ray, best);
}

}  // namespace robosim
