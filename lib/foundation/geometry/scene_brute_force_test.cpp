// Scene queries on thousands of random scenes, compared with loops over all solids.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/parallel_executor.h"
#include "geometry/scene.h"
#include "geometry/testing/slow_geometry.h"
#include "geometry/testing/slow_scene.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

testing::AssertionResult isSame(const Hit& fast, const Hit& slow) {
  const std::string difference = whatDiffers(fast, slow);
  return difference.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << difference;
}

testing::AssertionResult isExact(const Scene& scene, const Ray& ray, double range_m, BodyId except) {
  return isSame(scene.castRay(ray, range_m, except), castRaySlowly(scene, ray, range_m, except));
}

/// Whether `found` lists bodies in order, each once: all that overlap the area, and none whose bounds do not intersect
/// it.
testing::AssertionResult areNear(const std::vector<BodyId>& found, const Scene& scene, const Bounds2D& area) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < bodyCount(scene); ++i) {
    const Outline& outline = scene.solid(body(i)).outline;
    const Bounds2D b = boundsOf(outline);
    const bool may = b.x_min <= area.x_max && area.x_min <= b.x_max && b.y_min <= area.y_max && area.y_min <= b.y_max;
    const bool must = distance(outline, rectangle(area)) == 0;
    const bool is_found = next < found.size() && found[next] == body(i);
    if (is_found) ++next;
    if (must && !is_found) return testing::AssertionFailure() << "body " << i << " is missing";
    if (!may && is_found) return testing::AssertionFailure() << "body " << i << " is not near";
  }
  if (next == found.size()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "a body is listed twice or out of order";
}

struct Family {
  const char* name;
  SolidSpread solids;
  std::size_t count;
  Bounds2D area;  ///< of the scene's index
};

const Family kFamilies[] = {
    {"crowded", {.area = {-3, 3, -3, 3}, .size_max_m = 0.8}, 80, {-3, 3, -3, 3}},
    {"sparse", {.area = {-50, 50, -50, 50}}, 30, {-50, 50, -50, 50}},
    {"small world", {.area = {-1, 1, -1, 1}, .size_min_m = 0.01, .size_max_m = 0.3}, 20, {-1, 1, -1, 1}},
    {"of one solid", {}, 1, {-10, 10, -10, 10}},
    {"empty", {}, 0, {-10, 10, -10, 10}},
    {"huge solids", {.size_min_m = 5, .size_max_m = 100}, 10, {-10, 10, -10, 10}},
    {"boxes of all sizes", {.size_min_m = 0.001, .size_max_m = 30, .circle_share = 0}, 30, {-10, 10, -10, 10}},
    {"mostly beyond the area", {.area = {-20, 20, -20, 20}}, 60, {-4, 5, -3, 2}},
    {"far beyond the area", {.area = {100, 120, -20, 20}}, 20, {-5, 5, -5, 5}},
    // With so many solids, of which two thirds are stationary, the cells are 4 m, 2 m and 1 m wide: faces, corners and
    // rays lie on their borders.
    {"on a lattice of large cells", {.area = {-8, 8, -8, 8}, .size_max_m = 3, .lattice_m = 0.5}, 78, {-8, 8, -8, 8}},
    {"on a lattice", {.area = {-8, 8, -8, 8}, .size_max_m = 1, .lattice_m = 1}, 330, {-8, 8, -8, 8}},
    {"on a lattice of small cells", {.area = {-4, 4, -4, 4}, .size_max_m = 0.5, .lattice_m = 0.5}, 330, {-4, 4, -4, 4}},
    {"walls on a lattice",
     {.area = {-8, 8, -8, 8}, .size_max_m = 8, .circle_share = 0.1, .lattice_m = 0.5},
     150,
     {-8, 8, -8, 8}},
    {"far from zero",
     {.area = {4e6 - 8, 4e6 + 8, -5e6 - 8, -5e6 + 8}, .lattice_m = 0.5},
     150,
     {4e6 - 8, 4e6 + 8, -5e6 - 8, -5e6 + 8}},
    {"in a corridor", {.area = {-100, 100, -1, 1}, .size_max_m = 1}, 200, {-100, 100, -1, 1}},
};

/// A nearby multiple of half a metre, where cells have their borders and lattice solids their corners.
double onLattice(double x) { return std::round(2 * x) / 2; }

Bounds2D wider(const Bounds2D& b, double part) {
  const double dx = (b.x_max - b.x_min) * part, dy = (b.y_max - b.y_min) * part;
  return {b.x_min - dx, b.x_max + dx, b.y_min - dy, b.y_max + dy};
}

/// Random rays from inside or outside the area: arbitrary, along axes and borders, through corners, vertical, and in
/// space.
Ray randomTestRay(Rng& rng, const Bounds2D& area) {
  const Bounds2D from = wider(area, rng.below(3) ? 0 : 1);
  Ray ray = randomPlanarRay(rng, from, 0, 2);
  const double s = std::sqrt(0.5);
  switch (rng.below(6)) {
    case 0:
    case 1:
      return ray;
    case 2:
      return randomRay(rng, from, -1, 3);
    case 3: {
      const TPoint3D axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0.8, 0, -0.6}};
      ray.direction = axes[rng.below(7)];
      break;
    }
    case 4: {
      const TPoint3D diagonals[] = {{s, s, 0}, {-s, s, 0}, {s, -s, 0}, {-s, -s, 0}, {0.6, 0.8, 0}, {-0.8, 0.6, 0}};
      ray.direction = diagonals[rng.below(6)];
      break;
    }
    default: {  // from a corner of the lattice through another
      const double dx = rng.below(17) - 8.0, dy = rng.below(17) - 8.0;
      if (dx != 0 || dy != 0) ray.direction = TPoint3D(dx, dy, 0) * (1 / std::hypot(dx, dy));
    }
  }
  if (rng.below(2)) ray.origin = {onLattice(ray.origin.x), onLattice(ray.origin.y), onLattice(ray.origin.z)};
  return ray;
}

double randomRange(Rng& rng) {
  const double ranges[] = {0, 0.3, 2, 8, 20, 300, 1e9, kInfinity};
  return ranges[rng.below(8)];
}

BodyId randomBody(Rng& rng, const Scene& scene) {
  return bodyCount(scene) == 0 || rng.below(2) ? kNoBody : body(rng.below(std::uint32_t(bodyCount(scene))));
}

Scene randomScene(Rng& rng, const Family& family) {
  const std::size_t moving = family.count / 3;
  Scene scene(randomSolids(rng, family.count - moving, family.solids), moving, family.area);
  for (std::size_t i = 0; i < moving; ++i) scene.place(i, randomSolid(rng, family.solids));
  scene.freeze();
  return scene;
}

/// Calls ask(rng, scene, case) for many scenes of each family, before and after their moving solids have moved.
template <typename Ask>
void forManyScenes(std::uint64_t seed, const Ask& ask) {
  for (const Family& family : kFamilies) {
    Rng rng(seed);
    for (int i = 0; i < 300; ++i) {
      Scene scene = randomScene(rng, family);
      const std::string name = std::string("a scene ") + family.name + ", number " + std::to_string(i);
      ask(rng, scene, family.area, name);
      for (std::size_t k = 0; k < scene.movingCount(); ++k) scene.place(k, randomSolid(rng, family.solids));
      scene.freeze();
      ask(rng, scene, family.area, name + ", moved");
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Scene, CastsRaysLikeALoopOverAllSolids) {
  int hits = 0;
  forManyScenes(1, [&](Rng& rng, const Scene& scene, const Bounds2D& area, const std::string& name) {
    for (int i = 0; i < 30; ++i) {
      const Ray ray = randomTestRay(rng, area);
      const double range = randomRange(rng);
      const BodyId except = randomBody(rng, scene);
      ASSERT_TRUE(isExact(scene, ray, range, except)) << name << ", ray " << i << ", range " << range;
      const Hit hit = castRaySlowly(scene, ray, range, except);
      if (!hit) continue;
      ASSERT_TRUE(isExact(scene, ray, hit.distance_m, except)) << name << ", ray " << i << ", just out of range";
      hits += 1;
    }
  });
  EXPECT_GT(hits, 30000);
}

TEST(Scene, SensesSectorsLikeALoopOverAllSolids) {
  forManyScenes(2, [](Rng& rng, const Scene& scene, const Bounds2D& area, const std::string& name) {
    for (int i = 0; i < 15; ++i) {
      const Ray ray = randomTestRay(rng, area);
      const double half_width = rng.below(2) ? M_PI / 18 : rng.uniform(0.001, 1.57);
      const Sector sector = Sector::towards(ray.origin, std::atan2(ray.direction.y, ray.direction.x), half_width);
      const double range = randomRange(rng);
      const BodyId except = randomBody(rng, scene);
      ASSERT_EQ(whatDiffers(scene, sector, range, except), "") << name << ", sector " << i << ", range " << range;
    }
  });
}

TEST(Scene, ListsTheBodiesNearAnAreaOnceInOrder) {
  forManyScenes(3, [](Rng& rng, const Scene& scene, const Bounds2D& area, const std::string& name) {
    for (int i = 0; i < 10; ++i) {
      TPoint2D a = randomPoint(rng, wider(area, 0.5)), b = randomPoint(rng, wider(area, 0.5));
      if (rng.below(2)) a = {onLattice(a.x), onLattice(a.y)}, b = {onLattice(b.x), onLattice(b.y)};
      const auto [left, right] = std::minmax(a.x, b.x);
      const auto [low, high] = std::minmax(a.y, b.y);
      const Bounds2D asked{left, right, low, high};
      // Appended to existing entries, which must not change.
      const std::vector<BodyId> before{body(rng.below(9)), body(rng.below(9))};
      std::vector<BodyId> found = before;
      scene.findBodies(asked, found);
      const auto appended = found.begin() + std::ptrdiff_t(before.size());
      ASSERT_EQ(std::vector<BodyId>(found.begin(), appended), before) << name;
      found.erase(found.begin(), appended);
      ASSERT_TRUE(areNear(found, scene, asked)) << name;
      std::vector<FoundSolid> solids;
      scene.findSolids(asked, solids);
      std::vector<BodyId> same;
      for (const FoundSolid& solid : solids) {
        same.push_back(solid.body);
        const Solid expected = scene.solid(solid.body);
        ASSERT_EQ(solid.heights, expected.heights) << name;
        const Outline outline = solid.half_width_m == 0
                                    ? Outline(Circle{solid.center, solid.half_length_m})
                                    : OrientedBox{solid.center, solid.axis, solid.half_length_m, solid.half_width_m};
        ASSERT_EQ(boundsOf(outline), boundsOf(expected.outline)) << name;
      }
      std::sort(same.begin(), same.end());
      ASSERT_EQ(same, found) << name;
    }
  });
}

TEST(Scene, ClipsPathsLikeALoopOverAllSolids) {
  int clipped = 0;
  forManyScenes(5, [&](Rng& rng, Scene& scene, const Bounds2D& area, const std::string& name) {
    for (int i = 0; i < 10; ++i) {
      Path path = randomPath(rng, wider(area, 0.2));
      const double radius_m = rng.uniform(0.01, 0.5);
      const HeightSpan heights{rng.uniform(0, 1), rng.uniform(1, 2)};
      Path slow = path;
      for (std::size_t k = 0; k < scene.stationaryCount(); ++k) {
        const Solid solid = scene.solid(body(k));
        if (!solid.heights.overlaps(heights)) continue;
        slow.end_fraction = std::min(slow.end_fraction, firstContact(slow, radius_m, solid.outline));
      }
      // Without neighbours, or with those of a moving solid near the start.
      const bool with_neighbours = scene.movingCount() > 0 && rng.below(2) == 1;
      if (with_neighbours) {
        const auto& start = path.world_from_start;
        scene.place(0, {Circle{{start.x + rng.uniform(0, 0.5), start.y}, 0.1}, {0, 2}});
        scene.freeze();
        scene.updateNeighbours(0, rng.uniform(0, 12));
      }
      scene.clip(path, radius_m, heights, with_neighbours ? scene.movingBody(0) : kNoBody);
      ASSERT_EQ(path.end_fraction, slow.end_fraction) << name << ", path " << i;
      clipped += path.end_fraction < 1 ? 1 : 0;
    }
  });
  EXPECT_GT(clipped, 10000);
}

TEST(Scene, FindsAllMovingSolidsWithinReachOnce) {
  forManyScenes(6, [](Rng& rng, const Scene& scene, const Bounds2D& area, const std::string& name) {
    std::vector<std::uint32_t> found{7};
    for (int i = 0; i < 10; ++i) {
      const TPoint2D at = randomPoint(rng, wider(area, 0.5));
      const double reach_m = randomRange(rng);
      scene.findMoving(at, reach_m, scene.movingCount(), found);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << name;
      for (std::uint32_t k = 0; k < scene.movingCount(); ++k) {
        if (distance(scene.solid(scene.movingBody(k)).outline, at) > reach_m) continue;
        ASSERT_TRUE(std::binary_search(found.begin(), found.end(), k)) << name << ", solid " << k;
      }
    }
  });
}

TEST(Scene, SupportsConcurrentQueries) {
  Rng rng(4);
  const Scene scene = randomScene(rng, kFamilies[0]);
  std::vector<Ray> rays;
  for (int i = 0; i < 4000; ++i) rays.push_back(randomTestRay(rng, kFamilies[0].area));
  std::vector<Hit> alone(rays.size()), together(rays.size());
  ParallelExecutor(1).forEach(rays.size(), 16, [&](std::size_t i) { alone[i] = scene.castRay(rays[i], 20); });
  ParallelExecutor(4).forEach(rays.size(), 16, [&](std::size_t i) { together[i] = scene.castRay(rays[i], 20); });
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(isSame(together[i], alone[i])) << "ray " << i;
}

}  // namespace
}  // namespace robosim
