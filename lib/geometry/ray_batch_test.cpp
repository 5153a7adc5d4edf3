#include "geometry/ray_batch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/random_scene.h"
#include "geometry/scene.h"

namespace robosim {
namespace {

/// Casts level rays as a batch and one by one, and says where the two differ; empty if nowhere.
std::string difference(const Scene& scene, const std::vector<Ray>& rays, const mrpt::math::TPoint2D& center,
                       double range_m, BodyId except) {
  RayBatch batch;
  batch.begin(center, rays.front().origin.z, range_m, rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    batch.set(i, {rays[i].origin.x, rays[i].origin.y}, {rays[i].direction.x, rays[i].direction.y});
  }
  batch.finish();
  scene.castRays(batch, except);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit hit = scene.castRay(rays[i], range_m, except);
    const bool same = hit ? batch.body(i) == static_cast<std::int64_t>(hit.body) && batch.distance(i) == hit.distance_m
                          : batch.body(i) == RayBatch::kNothing && batch.distance(i) == range_m;
    if (!same) return "ray " + std::to_string(i) + " of " + std::to_string(rays.size());
  }
  return "";
}

TEST(RayBatch, GivesTheSameBitsAsItsRaysOneByOne) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    const SolidSpread spread{.size_max_m = rng.uniform(0.2, 6), .lattice_m = seed % 4 == 0 ? 0.125 : 0};
    const std::size_t moving = rng.below(30);
    Scene scene(randomSolids(rng, rng.below(100), spread), moving, spread.area);
    const auto bodies = randomSolids(rng, moving, spread);
    for (std::size_t i = 0; i < moving; ++i) scene.place(i, bodies[i]);
    scene.freeze();

    const auto center = seed % 7 == 0 ? mrpt::math::TPoint2D(25, -30) : randomPoint(rng, spread.area);
    const double z_m = rng.uniform(0, 2);
    const double spread_m = rng.below(2) ? 0 : rng.uniform(0, 0.5);  // one origin, or a ring of them
    const double first = seed % 4 == 0 ? 0 : rng.uniform(-M_PI, M_PI);
    const std::size_t count = 1 + rng.below(200);
    const double field = rng.below(2) ? 2 * M_PI : rng.uniform(0.01, M_PI);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = first + field * static_cast<double>(i) / static_cast<double>(count);
      const mrpt::math::TPoint3D origin(center.x + spread_m * std::cos(angle), center.y + spread_m * std::sin(angle),
                                        z_m);
      rays.push_back(Ray::towards(origin, angle));
    }
    const double ranges[] = {0, 0.3, 5, 8, 100, INFINITY};
    const BodyId except =
        moving > 0 && rng.below(2) ? scene.movingBody(rng.below(static_cast<std::uint32_t>(moving))) : kNoBody;
    EXPECT_EQ(difference(scene, rays, center, ranges[rng.below(6)], except), "") << "seed " << seed;
  }
}

TEST(RayBatch, OfNoRaysAsksNothing) {
  const Scene scene({{Circle{{1, 0}, 0.5}, {0, 1}}}, 0, {-5, 5, -5, 5});
  RayBatch batch;
  batch.begin({0, 0}, 0.5, 5, 0);
  batch.finish();
  scene.castRays(batch);
  EXPECT_EQ(batch.size(), 0u);
}

TEST(RayBatch, MayBeUsedAgainForOthers) {
  const Scene scene({{Circle{{2, 0}, 0.5}, {0, 1}}}, 0, {-5, 5, -5, 5});
  RayBatch batch;
  for (const double x : {0.0, 1.0, -1.0}) {
    batch.begin({x, 0}, 0.5, 5, 1);
    batch.set(0, {x, 0}, {1, 0});
    batch.finish();
    scene.castRays(batch);
    EXPECT_EQ(batch.distance(0), 1.5 - x);
    EXPECT_EQ(batch.body(0), 0);
  }
}

}  // namespace
}  // namespace robosim
