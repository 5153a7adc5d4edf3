#include "geometry/scene.h"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/testing/random_scene.h"
#include "geometry/testing/slow_scene.h"

// Counts the allocations of this program.
namespace {
std::atomic<long> allocations{0};
}  // namespace

// Not inline: g++ 12 would see the free() and warn about a mismatched deallocation.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace robosim {
namespace {

using mrpt::math::TPoint3D;

TEST(Scene, NumbersTheStationaryBodiesBeforeTheMovingOnes) {
  Scene scene({{Circle{{1, 0}, 0.1}, {0, 1}}, {Circle{{2, 0}, 0.1}, {0, 1}}}, 1, {-9, 9, -9, 9});
  EXPECT_EQ(scene.stationaryCount(), 2u);
  EXPECT_EQ(scene.movingCount(), 1u);
  EXPECT_EQ(scene.movingBody(0), BodyId{2});
  EXPECT_EQ(scene.movingIndex(BodyId{2}), 0u);
  scene.place(0, {Circle{{3, 0}, 0.1}, {0, 1}});
  scene.freeze();
  EXPECT_EQ(std::get<Circle>(scene.solid(BodyId{1}).outline).center.x, 2);
  EXPECT_EQ(std::get<Circle>(scene.solid(BodyId{2}).outline).center.x, 3);
}

TEST(Scene, SharesStationarySolidsWithOtherScenes) {
  const std::vector<Solid> pillars{{Circle{{5, 0}, 1}, {0, 1}}, {OrientedBox{{0, 7}, {1, 0}, 2, 1}, {0, 1}}};
  const Bounds2D area{-9, 9, -9, 9};
  auto first = std::make_unique<Scene>(indexStationary(pillars, area), 1);
  Scene second(first->stationary(), 2), own(pillars, 2, area);
  EXPECT_EQ(second.stationary(), first->stationary());
  EXPECT_NE(own.stationary(), first->stationary());
  first->place(0, {Circle{{2, 0}, 0.5}, {0, 1}});
  first->freeze();
  for (Scene* scene : {&second, &own}) {
    scene->place(1, {Circle{{0, 3}, 0.5}, {0, 1}});
    scene->freeze();
  }
  const Ray ahead{{0, 0, 0.5}, {1, 0, 0}}, left{{0, 0, 0.5}, {0, 1, 0}};
  EXPECT_EQ(first->castRay(ahead, 20).distance_m, 1.5);
  EXPECT_EQ(first->castRay(left, 20).distance_m, 6) << "not the solid of the other scene";
  first.reset();
  for (const Scene* scene : {&second, &own}) {
    EXPECT_EQ(scene->castRay(ahead, 20).distance_m, 4);
    EXPECT_EQ(scene->castRay(left, 20).distance_m, 2.5);
    EXPECT_EQ(scene->castRay(left, 20).body, BodyId{3});
  }
}

TEST(Scene, FindsTheNearestBodyExceptTheExcludedOne) {
  Scene scene({{Circle{{5, 0}, 1}, {0, 1}}, {OrientedBox{{9, 0}, {1, 0}, 1, 1}, {0, 1}}}, 1, {-10, 10, -10, 10});
  scene.place(0, {Circle{{0, 0}, 0.5}, {0, 1}});
  scene.freeze();
  const Ray ray{{0, 0, 0.5}, {1, 0, 0}};
  const Hit self = scene.castRay(ray, 20);
  EXPECT_EQ(self.body, scene.movingBody(0));
  EXPECT_EQ(self.distance_m, 0);
  const Hit other = scene.castRay(ray, 20, scene.movingBody(0));
  EXPECT_EQ(other.body, BodyId{0});
  EXPECT_EQ(other.distance_m, 4);
  EXPECT_EQ(other.point, TPoint3D(4, 0, 0.5));
  EXPECT_FALSE(scene.castRay({{0, 0, 1.5}, {1, 0, 0}}, 20)) << "above all solids";
  const Sector sector = Sector::towards({0, 0, 0.5}, 0, 0.2);
  EXPECT_EQ(senseSector(scene, sector, 20, scene.movingBody(0)).distance_m, 4);
  EXPECT_EQ(senseSector(scene, sector, 20).body, scene.movingBody(0));
}

TEST(Scene, FindsSolidsStrictlyNearerThanTheRange) {
  const Scene scene({{Circle{{5, 0}, 1}, {0, 1}}, {OrientedBox{{0, 0}, {1, 0}, 0.1, 0.1}, {0, 1}}}, 0, {-9, 9, -9, 9});
  const Ray ray{{1, 0, 0.5}, {1, 0, 0}};
  const Sector sector = Sector::towards(ray.origin, 0, 0.2);
  EXPECT_FALSE(scene.castRay(ray, 3));
  EXPECT_FALSE(senseSector(scene, sector, 3));
  EXPECT_EQ(scene.castRay(ray, std::nextafter(3, 4)).distance_m, 3);
  EXPECT_EQ(senseSector(scene, sector, std::nextafter(3, 4)).distance_m, 3);
  EXPECT_FALSE(scene.castRay({{0, 0, 0.5}, {1, 0, 0}}, 0)) << "not even from inside, where nothing is nearer than 0";
  EXPECT_FALSE(senseSector(scene, Sector::towards({0, 0, 0.5}, 0, 0.2), 0));
  EXPECT_TRUE(scene.castRay({{0, 0, 0.5}, {1, 0, 0}}, 1e-300));
}

TEST(Scene, PrefersTheLowestOfEquallyNearBodies) {
  const Solid pillar{Circle{{5, 0}, 1}, {0, 1}};
  Scene scene({{Circle{{0, 9}, 1}, {0, 1}}, pillar, pillar}, 2, {-10, 10, -10, 10});
  scene.place(0, pillar);
  scene.place(1, pillar);
  scene.freeze();
  const Ray ray{{0, 0, 0.5}, {1, 0, 0}};
  EXPECT_EQ(scene.castRay(ray, 20).body, BodyId{1});
  EXPECT_EQ(scene.castRay(ray, 20, BodyId{1}).body, BodyId{2});
  EXPECT_EQ(senseSector(scene, Sector::towards(ray.origin, 0, 0.2), 20).body, BodyId{1});
  EXPECT_EQ(senseSector(scene, Sector::towards({5, 0, 0.5}, 0, 0.2), 20).body, BodyId{1}) << "around the apex";
}

TEST(Scene, HitsSolidsTouchedOnCellBorders) {
  const double s = std::sqrt(0.5);
  for (double at = -7; at <= 7; ++at) {
    // This many solids on 16 m × 16 m make cells of 1 m, with borders at all whole metres; all but two lie far above.
    std::vector<Solid> solids(892, {Circle{{at, at}, 0.1}, {50, 51}});
    solids[0] = {OrientedBox{{at - 0.25, 7}, {1, 0}, 0.25, 0.5}, {0, 2}};           // left of x = at
    solids[1] = {OrientedBox{{at + 0.25, at - 0.25}, {1, 0}, 0.25, 0.25}, {4, 6}};  // its corner at (at, at)
    const Scene scene(solids, 0, {-8, 8, -8, 8});
    EXPECT_EQ(scene.castRay({{at, -8, 1}, {0, 1, 0}}, 20).distance_m, 14.5) << "along its right face";
    EXPECT_EQ(scene.castRay({{at, 12, 1}, {0, -1, 0}}, 20).distance_m, 4.5) << "the other way";
    EXPECT_EQ(scene.castRay({{-8, 7.5, 1}, {1, 0, 0}}, 20).distance_m, at + 7.5) << "along its far face";
    EXPECT_NEAR(scene.castRay({{-8, -8, 5}, {s, s, 0}}, 50).distance_m, (at + 8) / s, 1e-12) << "through a corner";
    EXPECT_NEAR(scene.castRay({{8, 8, 5}, {-s, -s, 0}}, 50).distance_m, (8 - at) / s, 1e-12) << "the other way";
  }
}

TEST(Scene, HandlesRaysAlmostParallelToAnAxis) {
  // 1 m cells; the ray starts on the border of two rows and deviates from it by less than the resolution of a double.
  std::vector<Solid> solids(892, {Circle{{0, 0}, 0.1}, {50, 51}});
  solids[0] = {OrientedBox{{5, 1}, {1, 0}, 0.5, 0.5}, {0, 2}};
  const Scene scene(solids, 0, {-8, 8, -8, 8});
  for (const double slope : {0.0, 1e-310, -1e-310, 1e-299, -1e-299}) {
    EXPECT_EQ(scene.castRay({{-7.5, 1, 1}, {1, slope, 0}}, 20).distance_m, 12) << slope;
  }
}

TEST(Scene, HitsSolidsBeyondItsArea) {
  const std::vector<Solid> solids{{Circle{{1, 0}, 0.5}, {0, 1}}, {Circle{{100, 0}, 1}, {0, 1}}};
  for (const bool with_another_beyond : {false, true}) {
    std::vector<Solid> all = solids;
    if (!with_another_beyond) all.pop_back();
    const Scene scene(all, 0, {-2, 2, -2, 2});
    EXPECT_EQ(scene.castRay({{-1, 0, 0.5}, {1, 0, 0}}, 200).distance_m, 1.5);
    EXPECT_EQ(scene.castRay({{-50, 0, 0.5}, {1, 0, 0}}, 200).distance_m, 50.5) << "from outside";
    EXPECT_EQ(bool(scene.castRay({{1.75, 0, 0.5}, {1, 0, 0}}, 200)), with_another_beyond) << "out of the area";
    EXPECT_EQ(bool(scene.castRay({{3, 0, 0.5}, {1, 0, 0}}, 200)), with_another_beyond) << "outside all the way";
    EXPECT_FALSE(scene.castRay({{1.75, 0, 0.5}, {1, 0, 0}}, 90)) << "within the range";
    EXPECT_FALSE(scene.castRay({{1.75, 0, 0.5}, {0, 1, 0}}, 200));
  }
  // A solid whose centre lies inside is hit where it extends beyond the area, near or far.
  const Scene scene({{OrientedBox{{0, 0}, {1, 0}, 5, 0.5}, {0, 1}}}, 0, {-2, 2, -2, 2});
  EXPECT_EQ(scene.castRay({{4.5, -1.5, 0.5}, {0, 1, 0}}, 9).distance_m, 1);
  EXPECT_EQ(scene.castRay({{9, 0, 0.5}, {-1, 0, 0}}, 9).distance_m, 4);
  std::vector<Solid> many(1000, {Circle{{1, 1}, 0.1}, {50, 51}});
  many.push_back({OrientedBox{{0, 0}, {0.6, 0.8}, 1e6, 0.5}, {0, 1}});
  const Scene far(many, 0, {-10, 10, -10, 10});
  EXPECT_NEAR(far.castRay({{3, -1, 0.5}, {-0.8, 0.6, 0}}, 9).distance_m, 2.5, 1e-12);
  EXPECT_NEAR(far.castRay({{6003, 7999, 0.5}, {-0.8, 0.6, 0}}, 9).distance_m, 2.5, 1e-9);
}

TEST(Scene, MissesWithNonFiniteRays) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const Solid wall{OrientedBox{{5, 0}, {0, 1}, 4, 0.1}, {0, 1}};
  for (const auto& solids : {std::vector<Solid>{}, {{Circle{{5, 0}, 1}, {0, 1}}}, {wall}}) {
    const Scene scene(solids, 0, {-9, 9, -9, 9});
    for (const double x : {nan, infinity, -infinity, 1e45}) {
      EXPECT_FALSE(scene.castRay({{x, 0, 0.5}, {0.6, 0.8, 0}}, 20)) << x;
      EXPECT_FALSE(scene.castRay({{0, x, 0.5}, {0.6, 0.8, 0}}, 20)) << x;
      EXPECT_FALSE(scene.castRay({{0, 0, 0.5}, {x, 0.8, 0}}, 20)) << x;
      EXPECT_FALSE(scene.castRay({{-20, 3, 0.5}, {0.1, x, 0}}, 20)) << x;
    }
    EXPECT_FALSE(scene.castRay({{0, 0, 0.5}, {1, 0, 0}}, nan)) << "within a range that is NaN";
  }
}

TEST(Scene, AppliesMovesWithFreeze) {
  Scene scene({}, 1, {-10, 10, -10, 10});
  for (double x : {5.0, -5.0, 500.0, 3.0}) {
    scene.place(0, {Circle{{x, 0}, 1}, {0, 1}});
    scene.freeze();
    const Hit hit = scene.castRay({{0, 0, 0.5}, {x < 0 ? -1.0 : 1.0, 0, 0}}, 1000);
    EXPECT_EQ(hit.distance_m, std::abs(x) - 1);
    EXPECT_FALSE(scene.castRay({{0, 0, 0.5}, {x < 0 ? 1.0 : -1.0, 0, 0}}, 1000));
  }
}

TEST(Scene, DoesNotAllocateInSteadyState) {
  constexpr std::size_t kMoving = 200;
  Rng rng(1);
  const SolidSpread spread{.size_max_m = 1};
  Scene scene(randomSolids(rng, 100, spread), kMoving, spread.area);
  std::vector<std::vector<Solid>> moments;
  for (int moment = 0; moment < 20; ++moment) moments.push_back(randomSolids(rng, kMoving, spread));
  std::vector<BodyId> near;
  near.reserve(10000);
  const std::vector<Sector> sectors(16, Sector::towards({0, 0, 0.5}, 1, 0.2));
  const BeamFan fan(sectors);
  BeamBatch batch;
  const auto live = [&] {
    for (const auto& moment : moments) {
      for (std::size_t i = 0; i < kMoving; ++i) scene.place(i, moment[i]);
      scene.freeze();
      near.clear();
      scene.findBodies(spread.area, near);
      for (int i = 0; i < 50; ++i) {
        const Ray ray = randomPlanarRay(rng, spread.area, 0, 2);
        scene.castRay(ray, 5);
        batch.place(fan, PlanarTransform({ray.origin.x, ray.origin.y, 1}, 0), 5);
        scene.cast(batch);
      }
    }
  };
  live();
  const long before = allocations;
  live();
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace robosim
