#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/casting/closest_hit.h"
#include "geometry/casting/cull_ray.h"
#include "geometry/casting/ray_intersection.h"
#include "geometry/index/grid_traversal.h"
#include "geometry/vector_width.h"

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The Hit of a ray, including its point.
inline Hit complete(const Ray& ray, const ClosestHit& hit) {
  return {hit.body != kNoBody ? hit.distance_m : kInfinity, hit.body, ray.at(hit.distance_m)};
}

}  // namespace

struct Scene::RayCaster {
  [[gnu::always_inline]] static inline Hit cast(const Scene* scene, const Ray* any_ray, double range_m, BodyId except) {
    const Ray& ray = *any_ray;
    const DoublePair origin{ray.origin.x, ray.origin.y};
    const DoublePair direction{ray.direction.x, ray.direction.y};
    const GridIndex& grid = scene->stationary_index_;
    const DoublePair in_cells = grid.inCells(origin);
    if (ray.direction.z != 0 || !grid.contains(in_cells)) [[unlikely]]
      return scene->castAnyRay(ray, range_m, except);

    GridTraversal traversal(grid, in_cells, direction);
    const DoublePair from = origin - DoublePair{grid.middle().x, grid.middle().y};
    const CullRay cull_ray{static_cast<float>(from[0]), static_cast<float>(from[1]), static_cast<float>(direction[0]),
                           static_cast<float>(direction[1])};
    traversal.setReach(std::max(range_m, 0.0));
    ClosestHit best{range_m};
    auto reach_m = static_cast<float>(range_m);
    for (const CellPack* pack = traversal.pack();;) {
      std::uint32_t may_hit = cull_ray.mayHit(*pack, grid.rectanglesOf(pack), reach_m);
      if (may_hit != 0) {
        for (; may_hit != 0; may_hit &= may_hit - 1) {
          const std::uint32_t index = pack->index[std::countr_zero(may_hit)];
          assert(index < grid.items().size());
          const GridItem& item = grid.items()[index];
          const double distance_m = intersectItem(item, origin, direction);
          if (item.heights.contains(ray.origin.z)) best.keepBetter(distance_m, BodyId{item.number}, except);
        }
        traversal.setReach(best.distance_m);
        reach_m = static_cast<float>(best.distance_m);
      }
      if (pack->hasNext()) [[unlikely]] {
        pack = &grid.packs()[pack->next()];
        continue;
      }
      if (!traversal.advance()) break;
      pack = traversal.pack();
    }
    if (!grid.containsAll() && traversal.leavesWithin(best.distance_m)) [[unlikely]]
      return scene->castAnyRay(ray, range_m, except);
    if (scene->movingCount() > 0) return scene->castAmongMoving(ray, except, best);
    return complete(ray, best);
  }
};

Hit Scene::castRay(const Ray& ray, double range_m, BodyId except) const {
  return withVectors<RayCaster::cast>(this, &ray, range_m, except);
}

Hit Scene::castAnyRay(const Ray& ray, double range_m, BodyId except) const {
  ClosestHit best{range_m};
  const auto reach = [&] { return best.distance_m; };
  const auto cast = [&](BodyId body) {
    best.keepBetter(intersect(ray, solid(body)).value_or(kInfinity), body, except);
  };
  stationary_index_.visitAlong(ray, reach, [&](std::uint32_t i) { cast(stationaryBody(i)); });
  moving_index_.visitAlong(ray, reach, [&](const CenterIndex::Entry& entry) { cast(movingBody(entry.index)); });
  return complete(ray, best);
}

Hit Scene::castAmongMoving(const Ray& ray, BodyId except, ClosestHit best) const {
  const DoublePair origin{ray.origin.x, ray.origin.y};
  const DoublePair direction{ray.direction.x, ray.direction.y};
  const auto reach = [&] { return best.distance_m; };
  const auto from = CullPoint::from({ray.origin.x, ray.origin.y}, 0, moving_index_.middle());
  const auto dx = static_cast<float>(ray.direction.x);
  const auto dy = static_cast<float>(ray.direction.y);
  moving_index_.visitAlong(ray, reach, [&](const CenterIndex::Entry& entry) {
    const float across = dx * (entry.solid.y - from.y) - dy * (entry.solid.x - from.x);
    if (std::abs(across) > entry.solid.reach() + from.rounding_m) return;
    const GridItem& item = moving_index_.items()[entry.index];
    if (!item.heights.contains(ray.origin.z)) return;
    best.keepBetter(intersectItem(item, origin, direction), movingBody(entry.index), except);
  });
  return complete(ray, best);
}

}  // namespace robosim
