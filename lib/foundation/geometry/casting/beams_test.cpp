#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/testing/vector_widths.h"
#include "geometry/testing/random_scene.h"
#include "geometry/testing/slow_scene.h"

namespace robosim {
namespace {

/// Pose of the rays' carrier, and the rotation about their own origins.
struct Mounting {
  PlanarTransform carrier;
  double pan_rad = 0;
};

/// Casts planar rays as a batch, with vectors of every width, and one by one, and describes where the results differ;
/// empty if nowhere.
/// @param batch may have been used before
std::string difference(const Scene& scene, const std::vector<Ray>& rays, const Mounting& mounting, double range_m,
                       BodyId owner, BeamBatch& batch) {
  const BeamFan fan(rays);
  const PlanarTransform panned(mounting.carrier, mounting.pan_rad);
  std::vector<Hit> hits;
  for (const auto& ray : rays) {
    hits.push_back(
        scene.castRay({mounting.carrier.pointToWorld(ray.origin), panned.turnToWorld(ray.direction)}, range_m, owner));
  }
  std::string text;
  forEachVectorWidth([&](VectorWidth width) {
    batch.place(fan, mounting.carrier, range_m, mounting.pan_rad);
    scene.cast(batch, owner);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool same =
          hits[i] ? batch.body(i) == static_cast<std::int64_t>(hits[i].body) && batch.distance(i) == hits[i].distance_m
                  : batch.body(i) == BeamBatch::kNothing && batch.distance(i) == range_m;
      if (!same) text = "ray " + std::to_string(i) + " of " + std::to_string(rays.size()) + ", " + nameOf(width);
    }
  });
  return text;
}

TEST(RayBeams, IsBitIdenticalToSingleRays) {
  BeamBatch batch;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    const SolidSpread spread{.size_max_m = rng.uniform(0.2, 6), .lattice_m = seed % 4 == 0 ? 0.125 : 0};
    const std::size_t moving = 1 + rng.below(30);
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
    // A full circle with the last ray on or before the first.
    const std::size_t parts = count > 1 && rng.below(2) ? count - 1 : count;
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = first + field * static_cast<double>(i) / static_cast<double>(parts);
      const mrpt::math::TPoint3D origin(center.x + spread_m * std::cos(angle), center.y + spread_m * std::sin(angle),
                                        z_m);
      rays.push_back(Ray::towards(origin, angle));
    }
    if (seed % 5 == 0) std::reverse(rays.begin(), rays.end());
    if (seed % 11 == 0) std::rotate(rays.begin(), rays.begin() + static_cast<std::ptrdiff_t>(count / 3), rays.end());
    Mounting mounting;
    if (rng.below(2)) {
      const auto at = randomPoint(rng, {-3, 3, -3, 3});
      mounting = {PlanarTransform({at.x, at.y, rng.uniform(-M_PI, M_PI)}, rng.uniform(0, 0.3)), rng.uniform(-1.6, 1.6)};
    }
    const auto world_center = mounting.carrier.pointToWorld(center);
    const double ranges[] = {0, 0.3, 5, 8, 100, INFINITY};
    const double range_m = ranges[rng.below(6)];
    const std::size_t owner = rng.below(static_cast<std::uint32_t>(moving));
    EXPECT_EQ(difference(scene, rays, mounting, range_m, kNoBody, batch), "") << "seed " << seed;
    EXPECT_EQ(difference(scene, rays, mounting, range_m, scene.movingBody(owner), batch), "") << "seed " << seed;
    // Also with the owner's neighbours: listed here, a step away, and for less than the range.
    for (const double away_m : {0.0, 0.3, 0.6}) {
      scene.place(owner, {Circle{{world_center.x + away_m, world_center.y}, 0.2}, {0, 2}});
      scene.freeze();
      scene.updateNeighbours(owner, rng.below(2) ? range_m + spread_m : range_m / 2);
      EXPECT_EQ(difference(scene, rays, mounting, range_m, scene.movingBody(owner), batch), "")
          << "seed " << seed << ", list " << away_m;
    }
  }
}

TEST(RayBeams, IsExactFarFromTheOrigin) {
  Rng rng(1);
  BeamBatch batch;
  for (int i = 0; i < 200; ++i) {
    const double far_m = rng.uniform(-40000, 40000);
    const SolidSpread spread{.area = {far_m - 10, far_m + 10, -far_m - 10, -far_m + 10}};
    const Scene scene(randomSolids(rng, 60, spread), 0, {-40010, 40010, -40010, 40010});
    std::vector<Ray> rays;
    const std::size_t count = 1 + rng.below(100);
    for (std::size_t k = 0; k < count; ++k) rays.push_back(Ray::towards({0, 0, 1}, rng.uniform(-M_PI, M_PI)));
    const auto at = randomPoint(rng, spread.area);
    EXPECT_EQ(difference(scene, rays, {PlanarTransform({at.x, at.y, 1}, 0)}, 8, kNoBody, batch), "") << i;
  }
}

TEST(RayBeams, RotatesTheFanWithItsCarrierAndEachRayAboutItsOrigin) {
  // From 1 m ahead of a carrier at (2, 3) that faces y; the ray itself is panned a quarter to the left, along -x.
  const Scene scene({{Circle{{-2, 4}, 0.5}, {0, 1}}, {Circle{{2, 9}, 0.5}, {0, 1}}}, 0, {-10, 10, -10, 10});
  const BeamFan fan(std::vector<Ray>{Ray::towards({1, 0, 0.25}, 0)});
  BeamBatch batch;
  const PlanarTransform carrier({2, 3, M_PI_2}, 0.25);
  batch.place(fan, carrier, 20, M_PI_2);
  scene.cast(batch);
  EXPECT_NEAR(batch.distance(0), 3.5, 1e-12);
  EXPECT_EQ(batch.body(0), 0);
  batch.place(fan, carrier, 20);
  scene.cast(batch);
  EXPECT_NEAR(batch.distance(0), 4.5, 1e-12);
  EXPECT_EQ(batch.body(0), 1);
}

TEST(RayBeams, AreBitIdenticalToSingleRaysWhenEachIsMoved) {
  BeamBatch batch;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Rng rng(seed);
    const SolidSpread spread{.size_max_m = rng.uniform(0.2, 6)};
    Scene scene(randomSolids(rng, rng.below(100), spread), 1, spread.area);
    const auto center = randomPoint(rng, spread.area);
    scene.place(0, {Circle{center, 0.2}, {0, 2}});
    scene.freeze();
    scene.updateNeighbours(0, rng.uniform(0, 10));
    const double turn_rad = rng.below(2) ? rng.uniform(0, 1) : rng.uniform(0, 0.05);
    const double shift_m = rng.below(4) ? rng.uniform(0, 0.5) : 0;
    const double field = rng.below(2) ? 2 * M_PI : rng.uniform(0.01, M_PI);
    const std::size_t count = 1 + rng.below(200);
    std::vector<Ray> fan_rays, moved;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = field * static_cast<double>(i) / static_cast<double>(count);
      fan_rays.push_back(Ray::towards({0, 0, 1}, angle));
      const double way = rng.uniform(-M_PI, M_PI), by_m = rng.uniform(0, shift_m);
      moved.push_back(Ray::towards({center.x + by_m * std::cos(way), center.y + by_m * std::sin(way), 1},
                                   angle + rng.uniform(-turn_rad, turn_rad)));
    }
    const BeamFan fan(fan_rays);
    const double range_m = rng.below(2) ? 8 : rng.uniform(0.3, 30);
    forEachVectorWidth([&](VectorWidth width) {
      batch.placeMoved(fan, PlanarTransform({center.x, center.y, 0}, 0), range_m, 0, {moved, shift_m, turn_rad});
      scene.cast(batch, scene.movingBody(0));
      for (std::size_t i = 0; i < count; ++i) {
        const Hit hit = scene.castRay(moved[i], range_m, scene.movingBody(0));
        ASSERT_EQ(batch.body(i), hit ? static_cast<std::int64_t>(hit.body) : BeamBatch::kNothing)
            << "seed " << seed << " ray " << i << nameOf(width);
        ASSERT_EQ(batch.distance(i), hit ? hit.distance_m : range_m) << "seed " << seed << " ray " << i;
      }
    });
  }
}

TEST(RayBeams, AcceptsAnEmptyFan) {
  const Scene scene({{Circle{{1, 0}, 0.5}, {0, 1}}}, 0, {-5, 5, -5, 5});
  const BeamFan fan;
  BeamBatch batch;
  batch.place(fan, {}, 5);
  scene.cast(batch);
  EXPECT_EQ(batch.size(), 0u);
}

TEST(RayBeams, IsReusable) {
  const Scene scene({{Circle{{2, 0}, 0.5}, {0, 1}}}, 0, {-5, 5, -5, 5});
  BeamBatch batch;
  for (const double x : {0.0, 1.0, -1.0}) {
    const BeamFan fan(std::vector<Ray>{Ray::towards({x, 0, 0.5}, 0)});
    batch.place(fan, {}, 5);
    scene.cast(batch);
    EXPECT_EQ(batch.distance(0), 1.5 - x);
    EXPECT_EQ(batch.body(0), 0);
  }
}

TEST(SectorBeams, IsEquivalentToSingleSectors) {
  int hits = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    const SolidSpread spread{.size_max_m = rng.uniform(0.2, 6)};
    const std::size_t moving = 1 + rng.below(30);
    Scene scene(randomSolids(rng, rng.below(60), spread), moving, spread.area);
    const auto bodies = randomSolids(rng, moving, spread);
    for (std::size_t i = 0; i < moving; ++i) scene.place(i, bodies[i]);
    scene.freeze();

    const auto center = randomPoint(rng, spread.area);
    const double z_m = rng.uniform(0, 2);
    const double ring_m = rng.below(2) ? 0 : rng.uniform(0, 0.5);
    const double ranges[] = {0, 0.3, 5, 100, INFINITY};
    const double range_m = ranges[rng.below(5)];
    const std::size_t owner = rng.below(static_cast<std::uint32_t>(moving));
    const BodyId except = rng.below(2) ? scene.movingBody(owner) : kNoBody;
    const std::size_t count = 1 + rng.below(24);
    std::vector<Sector> sectors;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
      const mrpt::math::TPoint3D apex(center.x + ring_m * std::cos(angle), center.y + ring_m * std::sin(angle), z_m);
      sectors.push_back(Sector::towards(apex, angle, rng.uniform(0.01, 1)));
    }
    const BeamFan fan(sectors);
    std::vector<Hit> singles;
    for (const auto& sector : sectors) {
      singles.push_back(senseSector(scene, sector, range_m, except));
      ASSERT_EQ(whatDiffers(scene, sector, range_m, except), "") << "seed " << seed;
    }
    if (rng.below(2)) {
      scene.place(owner, {Circle{{center.x + rng.uniform(0, 0.5), center.y}, 0.2}, {3, 4}});  // above all beams
      scene.freeze();
      scene.updateNeighbours(owner, rng.uniform(0, 6));
      for (std::size_t i = 0; i < count; ++i) singles[i] = senseSector(scene, sectors[i], range_m, except);
    }
    BeamBatch batch;
    forEachVectorWidth([&](VectorWidth width) {
      batch.place(fan, {}, range_m);
      scene.cast(batch, except);
      for (std::size_t i = 0; i < count; ++i) {
        const auto name = [&] {
          return "seed " + std::to_string(seed) + " sector " + std::to_string(i) + nameOf(width);
        };
        ASSERT_EQ(batch.body(i) != BeamBatch::kNothing, bool(singles[i])) << name();
        if (!singles[i]) continue;
        ++hits;
        ASSERT_EQ(batch.distance(i), singles[i].distance_m) << name();
        ASSERT_EQ(batch.body(i), static_cast<std::int64_t>(singles[i].body)) << name();
        ASSERT_EQ(sectors[i].apex.x + batch.towards(i).x, singles[i].point.x) << name();
        ASSERT_EQ(sectors[i].apex.y + batch.towards(i).y, singles[i].point.y) << name();
      }
    });
  }
  EXPECT_GT(hits, 5000);
}

/// Body found by a sector along x from the origin.
std::int64_t nearestBody(const std::vector<Solid>& stationary, const std::vector<Solid>& moving, double range_m,
                         BodyId except = kNoBody) {
  Scene scene(stationary, moving.size(), {-20, 20, -20, 20});
  for (std::size_t i = 0; i < moving.size(); ++i) scene.place(i, moving[i]);
  scene.freeze();
  const Hit hit = senseSector(scene, Sector::towards({0, 0, 0.5}, 0, 0.5), range_m, except);
  return hit ? static_cast<std::int64_t>(hit.body) : BeamBatch::kNothing;
}

TEST(SectorBeams, DetectsASolidBehindAllAxesButWithinASector) {
  // The axes are at ±80°, and the sectors reach to ±95°; the pillar is at 93°, 0.8 m behind the apex.
  const Solid pillar{Circle{{15 * std::cos(toRadians(93)), 15 * std::sin(toRadians(93))}, 0.1}, {0, 1}};
  const Scene scene({pillar}, 0, {-20, 20, -20, 20});
  const std::vector<Sector> sectors{Sector::towards({0, 0, 0.5}, toRadians(80), toRadians(15)),
                                    Sector::towards({0, 0, 0.5}, toRadians(-80), toRadians(15))};
  const BeamFan fan(sectors);
  BeamBatch batch;
  batch.place(fan, {}, 20);
  scene.cast(batch);
  EXPECT_EQ(batch.body(0), 0);
  EXPECT_NEAR(batch.distance(0), 14.9, 1e-9);
  EXPECT_EQ(batch.body(1), BeamBatch::kNothing);
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

}  // namespace
}  // namespace robosim
