#include "geometry/sector_batch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/random_scene.h"
#include "geometry/scene.h"

namespace robosim {
namespace {

TEST(SectorBatch, AnswersAsItsSectorsOneByOne) {
  int held = 0;
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
    const SectorFan fan(sectors);
    SectorBatch batch;
    batch.place(fan, {}, range_m);
    NeighbourList near;
    if (rng.below(2)) scene.update(near, {center.x + rng.uniform(0, 0.5), center.y}, rng.uniform(0, 6));
    scene.senseSectors(batch, except, near);
    for (std::size_t i = 0; i < count; ++i) {
      const Hit alone = scene.senseSector(sectors[i], range_m, except);
      ASSERT_EQ(batch.body(i) != SectorBatch::kNothing, static_cast<bool>(alone)) << "seed " << seed << " sector " << i;
      if (!alone) continue;
      ++held;
      ASSERT_NEAR(batch.distance(i), alone.distance_m, 1e-9) << "seed " << seed << " sector " << i;
      // From inside several solids any of them is the answer; elsewhere two are hardly ever as near.
      if (alone.distance_m > 0) {
        ASSERT_EQ(batch.body(i), static_cast<std::int64_t>(alone.body)) << "seed " << seed << " sector " << i;
      }
      ASSERT_NEAR(sectors[i].apex.x + batch.towards(i).x, alone.point.x, 1e-9) << "seed " << seed << " sector " << i;
      ASSERT_NEAR(sectors[i].apex.y + batch.towards(i).y, alone.point.y, 1e-9) << "seed " << seed << " sector " << i;
    }
  }
  EXPECT_GT(held, 5000);
}

TEST(SectorBatch, OfNoSectorsAsksNothing) {
  const Scene scene({{Circle{{1, 0}, 0.5}, {0, 1}}}, 0, {-5, 5, -5, 5});
  SectorBatch batch;
  const SectorFan fan;
  batch.place(fan, {}, 5);
  scene.senseSectors(batch);
  EXPECT_EQ(batch.size(), 0u);
}

}  // namespace
}  // namespace robosim
