#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "dynamics/testing/object_world.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

double distanceBetween(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

TEST(Walker, WalksItsRouteAndHomeAgain) {
  ObjectWorld world;
  const auto walker = world.addWalker({0, 0}, {.route = {{3, 0}, {3, 4}}, .speed_mps = 1});
  world.run(2);
  EXPECT_NEAR(world.at(walker).x, 2, 1e-9);
  EXPECT_NEAR(world.at(walker).y, 0, 1e-9);
  world.run(3);
  EXPECT_NEAR(world.at(walker).x, 3, 1e-9);
  EXPECT_NEAR(world.at(walker).y, 2, 1e-9);
  world.run(4);  // 2 m to the last place, and 2 of the 5 m home
  EXPECT_NEAR(world.at(walker).x, 3 - 2 * 0.6, 1e-9);
  EXPECT_NEAR(world.at(walker).y, 4 - 2 * 0.8, 1e-9);
  world.run(3);
  EXPECT_NEAR(world.at(walker).x, 0, 1e-9);
  EXPECT_EQ(world.objects[walker].walk.leg, 0u);
}

TEST(Walker, StopsBeforeARobotAndTurnsBackAfterItsPatience) {
  ObjectWorld world;
  const auto walker = world.addWalker({0, 0}, {.route = {{6, 0}}, .speed_mps = 1, .stops_within_m = 0.5});
  const auto robot = world.addRobot({3, 0, 0}, 0);
  world.run(3);
  // The robot's rim is at 2.75 m, the walker's 0.25 m ahead of its centre.
  EXPECT_LE(world.at(walker).x, 2.75 - 0.25 - 0.5);
  EXPECT_GT(world.at(walker).x, 2.75 - 0.25 - 0.5 - 0.1 - 1e-9) << "it stops within a step's way";
  EXPECT_EQ(world.poses[robot], mrpt::math::TPose2D(3, 0, 0));
  world.run(7);
  EXPECT_NEAR(world.at(walker).x, 1.2, 1e-9) << "2 s to the robot, 5 s patience, 0.8 m towards home";
  EXPECT_TRUE(world.objects[walker].walk.is_returning);
}

TEST(Walker, IsNotPushedByARobotAndDoesNotPushIt) {
  ObjectWorld world;
  const auto walker = world.addWalker({0, 0}, {.route = {{0, 3}}, .speed_mps = 0.01});
  const auto robot = world.addRobot({-2, 0, 0}, 0.5);
  world.run(5);
  EXPECT_TRUE(world.is_blocked[robot]);
  EXPECT_NEAR(distanceBetween(world.at(walker), world.poses[robot]), 0.5, 1e-3);
  EXPECT_NEAR(world.at(walker).x, 0, 1e-12);
  EXPECT_EQ(world.deepestOverlap(), 0);
}

TEST(Walker, IsStoppedByARobotThatDrivesIntoItsWay) {
  ObjectWorld world;
  const auto walker = world.addWalker({0, 0}, {.route = {{6, 0}}, .speed_mps = 1.5, .stops_within_m = 0});
  world.addRobot({3, -3, M_PI_2}, 1.6);
  for (int i = 0; i < 60; ++i) {
    world.step();
    ASSERT_EQ(world.deepestOverlap(), 0) << "step " << i;
  }
  EXPECT_NEAR(world.at(walker).y, 0, 1e-9);
}

TEST(Walker, WandersNearItsHomeAndNotIntoWalls) {
  ObjectWorld world;
  world.addWall({1, 0, M_PI_2}, 4, 0.1);
  const auto walker = world.addWalker({0, 0}, {.wanders_within_m = 3, .speed_mps = 1.4});
  double way_m = 0;
  for (int i = 0; i < 1200; ++i) {
    const auto before = world.at(walker);
    world.step();
    way_m += distanceBetween(before, world.at(walker));
    ASSERT_LE(distanceBetween(world.at(walker), {0, 0, 0}), 3 + 1e-9);
    ASSERT_EQ(world.deepestOverlap(), 0);
  }
  EXPECT_GT(way_m, 0.8 * 120 * 1.4);
}

TEST(Walker, WalksDifferentlyForAnotherNameOrSeed) {
  const Walker walker{.wanders_within_m = 5};
  const TPoint2D one = walker.targetOf({}, 1, Walker::streamOf("one"));
  EXPECT_EQ(walker.targetOf({}, 1, Walker::streamOf("one")), one);
  EXPECT_NE(walker.targetOf({}, 2, Walker::streamOf("one")), one);
  EXPECT_NE(walker.targetOf({}, 1, Walker::streamOf("two")), one);
  EXPECT_NE(walker.targetOf({.leg = 1}, 1, Walker::streamOf("one")), one);
}

TEST(Walker, OpensADoorAndIsNotHitByIt) {
  ObjectWorld world;
  world.addWall({0, 6, M_PI_2}, 8.2, 0.1);  // the open door ends before it
  world.addWall({0, -6, M_PI_2}, 8.2, 0.1);
  world.addDoor({0, 0, M_PI_2}, 1.1, {.slide_m = 1.2, .speed = 1, .opens_within_m = 1.5});
  const auto walker = world.addWalker({-4, 0}, {.route = {{4, 0}}, .speed_mps = 1.2});
  bool has_passed = false;
  for (int i = 0; i < 150; ++i) {
    world.step();
    ASSERT_LE(world.deepestOverlap(), 1e-12) << "step " << i;
    has_passed |= world.at(walker).x > 3;
  }
  EXPECT_TRUE(has_passed);
}

TEST(Walker, KeepsFromOthersInCrowds) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ObjectWorld world({-4, 4, -4, 4});
    Rng rng(seed);
    for (int i = 0; i < 16; ++i) {
      world.addWalker({-3 + 2. * (i % 4), -3 + 2. * (i / 4)}, {.wanders_within_m = 4, .speed_mps = rng.uniform(0.5, 2)},
                      "walker " + std::to_string(i));
    }
    const auto robot = world.addRobot({-2, -2, rng.uniform(-M_PI, M_PI)}, 0.8);
    world.addDoor({3.5, 0, 0}, 1, {.turn_rad = 2, .speed = 2, .opens_within_m = 1});
    const auto box = world.addBox({-3.4, 3.4, 0}, 0.4, 0.4);
    for (int i = 0; i < 300; ++i) {
      if (world.is_blocked[robot]) world.poses[robot].phi += rng.uniform(1, 4);
      world.step();
      ASSERT_LE(world.deepestOverlap(), 1e-9) << "seed " << seed << ", step " << i;
    }
    EXPECT_LT(std::abs(world.at(box).x), 4);
  }
}

TEST(Conveyor, CarriesABoxAtItsSpeedToItsEnd) {
  ObjectWorld world;
  world.addConveyor({0, 0, M_PI_2}, 4, 1, 0.5);
  const auto box = world.addBox({0, -1.9, 0}, 0.3, 0.3, {.mass_kg = 2});
  world.run(3);
  // Friction accelerates it at 0.5 g, so it falls behind the belt by v² / (2 · 0.5 g).
  EXPECT_NEAR(world.at(box).y, -1.9 + 3 * 0.5 - 0.5 * 0.5 / (2 * 0.5 * 9.81), 3e-3);
  EXPECT_NEAR(world.objects[box].vy_mps, 0.5, 1e-12);
  EXPECT_NEAR(world.at(box).x, 0, 1e-12);
  world.run(10);
  EXPECT_TRUE(world.objects[box].isAtRest());
  EXPECT_NEAR(world.at(box).y, 2 + 0.5 * 0.5 / (2 * 0.5 * 9.81), 6e-3);
}

TEST(Conveyor, PressesABoxAgainstAWallAndARobotWithoutForce) {
  ObjectWorld world;
  world.addConveyor({0, 0, 0}, 4, 1, 1);
  world.addWall({1.5, 0, M_PI_2}, 2, 0.1);
  const auto box = world.addBox({0, 0, 0}, 0.4, 0.4);
  world.run(4);
  EXPECT_NEAR(world.at(box).x, 1.5 - 0.05 - 0.2, 1e-4);
  EXPECT_EQ(world.deepestOverlap(), 0);
}

TEST(Conveyor, HelpsARobotThatPushesWithIt) {
  // 100 kg · 0.5 · g is too much for 30 N; the belt moves the box ahead of the robot.
  ObjectWorld world;
  world.addConveyor({0, 0, 0}, 8, 1, 0.3);
  const auto box = world.addBox({-1, 0, 0}, 0.4, 0.4, {.mass_kg = 100});
  const auto robot = world.addRobot({-1.46, 0, 0}, 0.3, 30);
  world.run(5);
  EXPECT_FALSE(world.is_blocked[robot]);
  EXPECT_NEAR(world.poses[robot].x, -1.46 + 5 * 0.3, 1e-9);
  EXPECT_GT(world.at(box).x, 0.4);
}

}  // namespace
}  // namespace robosim
