#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/vector_width.h"
#include "geometry/casting/grid_traversal.h"
#include "geometry/casting/single_ray.h"
#include "geometry/scene_index.h"

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The Hit of a ray, including its point.
inline Hit complete(const Ray& ray, const ClosestHit& hit) {
  return {hit.body != kNoBody ? hit.distance_m : kInfinity, hit.body, ray.at(hit.distance_m)};
}

/// Casts a ray that is not planar or leaves the grid's interior.
Hit castAnyRay(const SceneIndex& scene, const Ray& ray, double range_m, BodyId owner) {
  ClosestHit best{range_m};
  const auto reach = [&] { return best.distance_m; };
  const auto cast = [&](const GridItem& item, BodyId body) {
    best.keepBetter(intersect(ray, item.solid()).value_or(kInfinity), body, owner);
  };
  scene.stationary.visitAlong(
      ray, reach, [&](std::uint32_t i) { cast(scene.stationary.items()[i], BodyId{scene.stationary.numberOf(i)}); });
  scene.moving.visitAlong(ray, reach, [&](const CenterIndex::Entry& entry) {
    cast(scene.moving.items()[entry.index], scene.movingBody(entry.index));
  });
  return complete(ray, best);
}

/// The given hit, or a nearer one of a planar ray among the moving solids.
Hit castAmongMoving(const SceneIndex& scene, const Ray& ray, BodyId owner, ClosestHit best) {
  const DoublePair origin{ray.origin.x, ray.origin.y};
  const DoublePair direction{ray.direction.x, ray.direction.y};
  const auto reach = [&] { return best.distance_m; };
  const auto from = CullPoint::from({ray.origin.x, ray.origin.y}, 0, scene.moving.middle());
  const auto dx = static_cast<float>(ray.direction.x);
  const auto dy = static_cast<float>(ray.direction.y);
  scene.moving.visitAlong(ray, reach, [&](const CenterIndex::Entry& entry) {
    const float across = dx * (entry.disc.y - from.y) - dy * (entry.disc.x - from.x);
    if (std::abs(across) > entry.disc.radius_m + from.rounding_m) return;
    const GridItem& item = scene.moving.items()[entry.index];
    if (!item.heights.contains(ray.origin.z)) return;
    best.keepBetter(intersectItem(item, origin, direction), scene.movingBody(entry.index), owner);
  });
  return complete(ray, best);
}

[[gnu::always_inline]] inline Hit castPlanarRay(const SceneIndex* scene, const Ray* any_ray, double range_m,
                                                BodyId owner) {
  const Ray& ray = *any_ray;
  const DoublePair origin{ray.origin.x, ray.origin.y};
  const DoublePair direction{ray.direction.x, ray.direction.y};
  const GridIndex& grid = scene->stationary;
  const DoublePair in_cells = inCells(grid, origin);
  if (ray.direction.z != 0 || !contains(grid, in_cells)) [[unlikely]]
    return castAnyRay(*scene, ray, range_m, owner);

  GridTraversal traversal(grid, in_cells, direction);
  const DoublePair from = origin - pairOf(grid.middle());
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
        if (item.heights.contains(ray.origin.z)) best.keepBetter(distance_m, BodyId{grid.numberOf(index)}, owner);
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
    return castAnyRay(*scene, ray, range_m, owner);
  if (!scene->moving.items().empty()) return castAmongMoving(*scene, ray, owner, best);
  return complete(ray, best);
}

}  // namespace

Hit Scene::castRay(const Ray& ray, double range_m, BodyId owner) const {
  return withVectors<castPlanarRay>(static_cast<const SceneIndex*>(index_.get()), &ray, range_m, owner);
}

}  // namespace robosim
