#include "dynamics/object_mover.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "base/random.h"
#include "dynamics/testing/object_world.h"

namespace robosim {
namespace {

/// Number of random worlds; more in tests/verify/objects.sh.
int sceneCount() { return std::getenv("ROBOSIM_VERIFY") ? 10000 : 150; }

/// Whether nothing is within a distance of a place.
bool isFree(const ObjectWorld& world, const mrpt::math::TPoint2D& at, double radius_m) {
  const Circle disc{at, radius_m};
  const auto is_clear = [&](const Outline& outline) { return distance(outline, at) > disc.radius_m; };
  for (const auto& wall : world.walls) {
    if (!is_clear(wall.outline)) return false;
  }
  for (std::size_t k = 0; k < world.objects.size(); ++k) {
    if (!is_clear(world.outlineOf(k))) return false;
  }
  for (std::size_t r = 0; r < world.robots.size(); ++r) {
    if (!is_clear(Circle{{world.poses[r].x, world.poses[r].y}, world.robots[r].radius_m})) return false;
  }
  return true;
}

/// A crowded world of boxes, discs, walls and robots.
ObjectWorld randomWorld(std::uint64_t seed, int robots) {
  Rng rng(seed, RandomPurpose::test);
  const double half_m = 2;
  ObjectWorld world({-half_m, half_m, -half_m, half_m});
  const auto place = [&](double radius_m, const auto& add) {
    for (int i = 0; i < 30; ++i) {
      const mrpt::math::TPose2D at(rng.uniform(radius_m - half_m, half_m - radius_m),
                                   rng.uniform(radius_m - half_m, half_m - radius_m), rng.uniform(-M_PI, M_PI));
      if (isFree(world, {at.x, at.y}, radius_m)) return static_cast<void>(add(at));
    }
  };
  for (auto i = rng.below(3); i > 0; --i) {
    const double length_m = rng.uniform(0.1, 1);
    place(0.51 * std::hypot(length_m, 0.05), [&](const auto& at) { world.addWall(at, length_m, 0.05); });
  }
  for (auto i = 2 + rng.below(10); i > 0; --i) {
    const Movable movable{.mass_kg = std::pow(10, rng.uniform(-1, 1.5)),
                          .friction = rng.below(3) == 0 ? 0.01 : rng.uniform(0.1, 1),
                          .restitution = rng.below(2) == 0 ? 0 : rng.uniform()};
    const double length_m = rng.uniform(0.06, 0.8);
    const double width_m = rng.uniform(0.06, 0.4);
    const bool is_box = rng.below(3) > 0;
    const double radius_m = is_box ? std::hypot(length_m, width_m) / 2 : width_m / 2;
    place(radius_m + 1e-9, [&](const auto& at) {
      const auto object = is_box ? world.addBox(at, length_m, width_m, movable) : world.addDisc(at, radius_m, movable);
      if (rng.below(3) > 0) return;
      world.objects[object].vx_mps = rng.uniform(-2, 2);
      world.objects[object].vy_mps = rng.uniform(-2, 2);
      world.objects[object].turn_radps = is_box ? rng.uniform(-4, 4) : 0;
    });
  }
  for (int i = 0; i < robots; ++i) {
    place(0.2 + 1e-6, [&](const auto& at) {
      world.addRobot(at, rng.uniform(-0.5, 1), rng.uniform(5, 200), 0.2);
      world.turns_radps.push_back(rng.uniform(-1, 1));
    });
  }
  return world;
}

std::vector<double> numbersOf(const ObjectWorld& world) {
  std::vector<double> numbers;
  for (const auto& motion : world.objects) {
    const auto& pose = motion.world_from_object;
    numbers.insert(numbers.end(), {pose.x, pose.y, pose.phi, motion.vx_mps, motion.vy_mps, motion.turn_radps});
  }
  for (const auto& pose : world.poses) numbers.insert(numbers.end(), {pose.x, pose.y, pose.phi});
  return numbers;
}

TEST(ObjectMover, LetsNothingOverlapInRandomWorlds) {
  for (int seed = 0; seed < (sceneCount()); ++seed) {
    // One robot: others would need move authorisation among themselves.
    ObjectWorld world = randomWorld(static_cast<std::uint64_t>(seed), 1);
    ASSERT_EQ(world.deepestOverlap(), 0) << seed;
    for (int step = 0; step < 30; ++step) {
      world.step();
      ASSERT_LE(world.deepestOverlap(), 1e-9) << seed << " in step " << step;
    }
  }
}

TEST(ObjectMover, NeverIncreasesTheEnergyOfObjectsAmongThemselves) {
  for (int seed = 0; seed < (sceneCount()); ++seed) {
    ObjectWorld world = randomWorld(static_cast<std::uint64_t>(seed), 0);
    double before_j = world.energy();
    for (int step = 0; step < 20; ++step) {
      world.step();
      ASSERT_LE(world.energy(), before_j * (1 + 1e-12)) << seed << " in step " << step;
      before_j = world.energy();
    }
  }
}

TEST(ObjectMover, GivesTheSameResultForAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    // Several worlds side by side, for several groups.
    const ObjectWorld start = randomWorld(seed, 1);
    std::vector<double> of_one;
    for (const int threads : {1, 2, 3, 8}) {
      ObjectWorld world = start;
      for (int step = 0; step < 10; ++step) world.step(0.1, threads);
      if (threads == 1) of_one = numbersOf(world);
      EXPECT_EQ(numbersOf(world), of_one) << seed << " with " << threads << " threads";
    }
  }
}

TEST(ObjectMover, ComputesNothingForObjectsAtRest) {
  ObjectWorld world;
  world.addBox({0, 0, 0}, 0.4, 0.4);
  world.addRobot({-2, 0, 0}, 0.1);
  std::vector<Path> paths{{world.poses[0], 0.01, 0}};
  ObjectMover mover(world.bodies, {}, world.robots, world.surface);
  EXPECT_FALSE(mover.move(world.scene(), ParallelExecutor(1), 0.1, 1, {}, paths, world.objects));
  world.poses[0].x = -0.46;
  paths[0].world_from_start = world.poses[0];
  EXPECT_TRUE(mover.move(world.scene(), ParallelExecutor(1), 0.1, 1, {}, paths, world.objects))
      << "10 mm ahead of the robot";
}

TEST(ObjectMover, StopsOtherRobotsWhereOneIsBlocked) {
  // The second robot crosses the way of the first behind it. An immovable box stops the first in its way.
  ObjectWorld world;
  world.addRobot({0, 0, 0}, 10, 1);
  world.addRobot({0.6, -0.6, M_PI_2}, 1.5, 1);
  world.addBox({0.6, 0, 0}, 0.4, 0.4, {.mass_kg = 1000});
  world.step();
  EXPECT_TRUE(world.is_blocked[0]);
  EXPECT_EQ(world.deepestOverlap(), 0);
}

}  // namespace
}  // namespace robosim
