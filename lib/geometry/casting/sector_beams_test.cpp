#include <cmath>

#include <gtest/gtest.h>

#include "geometry/casting/beam_batch.h"
#include "geometry/scene.h"
#include "geometry/testing/random_scene.h"
#include "geometry/testing/vector_widths.h"

namespace robosim {
namespace {

TEST(SectorBeams, IsEquivalentToSingleSectors) {
  int hits = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    const SolidSpread spread{.size_max_m = rng.uniform(0.2, 6)};
    const std::size_t moving = rng.below(30);
    Scene scene(randomSolids(rng, rng.below(60), spread), moving, spread.area);
    const auto bodies = randomSolids(rng, moving, spread);
    for (std::size_t i = 0; i < moving; ++i) scene.place(i, bodies[i]);
    scene.freeze();

    const auto center = randomPoint(rng, spread.area);
    const double z_m = rng.uniform(0, 2);
    const double ring_m = rng.below(2) ? 0 : rng.uniform(0, 0.5);
    const double ranges[] = {0, 0.3, 5, 100, INFINITY};
    const double range_m = ranges[rng.below(5)];
    const BodyId except =
        moving > 0 && rng.below(2) ? scene.movingBody(rng.below(static_cast<std::uint32_t>(moving))) : kNoBody;
    const std::size_t count = 1 + rng.below(24);
    std::vector<Sector> sectors;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
      const mrpt::math::TPoint3D apex(center.x + ring_m * std::cos(angle), center.y + ring_m * std::sin(angle), z_m);
      sectors.push_back(Sector::towards(apex, angle, rng.uniform(0.01, 1)));
    }
    const BeamFan fan(sectors);
    BeamBatch batch;
    batch.place(fan, {}, range_m);
    NeighbourList near;
    if (rng.below(2)) scene.update(near, {center.x + rng.uniform(0, 0.5), center.y}, rng.uniform(0, 6));
    scene.cast(batch, except, near);
    const BeamBatch widest = batch;
    forEachVectorWidth([&](VectorWidth width) {
      batch.place(fan, {}, range_m);
      scene.cast(batch, except, near);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(batch.distance(i), widest.distance(i)) << "seed " << seed << " " << nameOf(width);
        EXPECT_EQ(batch.body(i), widest.body(i)) << "seed " << seed << " " << nameOf(width);
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      const Hit single = scene.senseSector(sectors[i], range_m, except);
      ASSERT_EQ(batch.body(i) != BeamBatch::kNothing, static_cast<bool>(single)) << "seed " << seed << " sector " << i;
      if (!single) continue;
      ++hits;
      ASSERT_NEAR(batch.distance(i), single.distance_m, 1e-9) << "seed " << seed << " sector " << i;
      ASSERT_EQ(batch.body(i), static_cast<std::int64_t>(single.body)) << "seed " << seed << " sector " << i;
      ASSERT_NEAR(sectors[i].apex.x + batch.towards(i).x, single.point.x, 1e-9) << "seed " << seed << " sector " << i;
      ASSERT_NEAR(sectors[i].apex.y + batch.towards(i).y, single.point.y, 1e-9) << "seed " << seed << " sector " << i;
    }
  }
  EXPECT_GT(hits, 5000);
}

/// Body found by a sector along x from the origin in a batch; checks that a single sector finds the same.
std::int64_t nearestBody(const std::vector<Solid>& stationary, const std::vector<Solid>& moving, double range_m,
                         BodyId except = kNoBody) {
  Scene scene(stationary, moving.size(), {-20, 20, -20, 20});
  for (std::size_t i = 0; i < moving.size(); ++i) scene.place(i, moving[i]);
  scene.freeze();
  const Sector sector = Sector::towards({0, 0, 0.5}, 0, 0.5);
  const BeamFan fan(std::span(&sector, 1));
  BeamBatch batch;
  batch.place(fan, {}, range_m);
  scene.cast(batch, except);
  const Hit single = scene.senseSector(sector, range_m, except);
  EXPECT_EQ(batch.body(0), single ? static_cast<std::int64_t>(single.body) : BeamBatch::kNothing);
  return batch.body(0);
}

TEST(SectorBeams, ReportsTheLowestOfEquallyNearBodies) {
  const auto circle = [](double x, double y) { return Solid{Circle{{x, y}, 1}, {0, 1}}; };
  // Mirrored at the axis, both nearest points are √(3² + 1²) − 1 away: the same bits, for only a sign differs.
  EXPECT_EQ(nearestBody({circle(3, 1), circle(3, -1)}, {}, 9), 0);
  EXPECT_EQ(nearestBody({circle(3, -1), circle(3, 1)}, {}, 9), 0);
  EXPECT_EQ(nearestBody({circle(9, 0), circle(3, 0), circle(3, 0), circle(3, 0)}, {}, 9), 1);
  EXPECT_EQ(nearestBody({circle(9, 0)}, {circle(3, 0), circle(3, 0)}, 9), 1);
  EXPECT_EQ(nearestBody({circle(9, 0), circle(3, 0)}, {circle(3, 0)}, 9), 1) << "stationary before moving";
  EXPECT_EQ(nearestBody({}, {circle(3, 0), circle(3, 0)}, 9, BodyId{0}), 1) << "except the excluded body";
}

TEST(SectorBeams, ReportsTheLowestBodyAroundTheApex) {
  const auto around = [](double size_m) { return Solid{OrientedBox::from({0.1, 0, 0.3}, size_m, size_m), {0, 1}}; };
  const Solid circle{Circle{{-0.2, 0.1}, 2}, {0, 1}};
  EXPECT_EQ(nearestBody({around(3), circle, around(5)}, {}, 9), 0);
  EXPECT_EQ(nearestBody({{Circle{{5, 0}, 1}, {0, 1}}, circle, around(3)}, {circle, around(9)}, 9), 1);
  EXPECT_EQ(nearestBody({}, {around(3), circle}, 9), 0);
  EXPECT_EQ(nearestBody({circle}, {around(3), circle}, 9, BodyId{0}), 1);
}

TEST(SectorBeams, AcceptsAnEmptyFan) {
  const Scene scene({{Circle{{1, 0}, 0.5}, {0, 1}}}, 0, {-5, 5, -5, 5});
  BeamBatch batch;
  const BeamFan fan;
  batch.place(fan, {}, 5);
  scene.cast(batch);
  EXPECT_EQ(batch.size(), 0u);
}

}  // namespace
}  // namespace robosim
