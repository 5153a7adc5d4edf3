#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/testing/object_world.h"

namespace robosim {
namespace {

TEST(Door, SlidesAtItsSpeedAndStopsWhereItIsToBe) {
  ObjectWorld world;
  const auto door = world.addDoor({1, 2, M_PI_2}, 1, {.slide_m = 0.9, .speed = 0.5, .open_to = 1});
  world.run(1);
  EXPECT_NEAR(world.at(door).y, 2.5, 1e-12);
  EXPECT_NEAR(world.objects[door].door_share, 0.5 / 0.9, 1e-12);
  world.run(1);
  EXPECT_NEAR(world.at(door).y, 2.9, 1e-12);
  EXPECT_EQ(world.objects[door].door_share, 1);
  world.objects[door].open_to = 0;
  world.run(3);
  EXPECT_EQ(world.at(door), mrpt::math::TPose2D(1, 2, M_PI_2));
}

TEST(Door, TurnsAboutItsHinge) {
  ObjectWorld world;
  const auto door = world.addDoor({0, 0, 0}, 1, {.turn_rad = M_PI_2, .speed = 1, .open_to = 1});
  world.run(2);
  // The hinge is at (-0.5, 0).
  EXPECT_NEAR(world.at(door).x, -0.5, 1e-12);
  EXPECT_NEAR(world.at(door).y, 0.5, 1e-12);
  EXPECT_NEAR(world.at(door).phi, M_PI_2, 1e-12);
}

TEST(Door, OpensForARobotNearbyAndClosesBehindIt) {
  ObjectWorld world;
  const auto door = world.addDoor({0, 0, M_PI_2}, 1, {.slide_m = 1, .speed = 2, .opens_within_m = 0.5});
  const auto robot = world.addRobot({-2, 0, 0}, 0.5);
  world.run(2);  // it stands 0.7 m before the door
  EXPECT_EQ(world.objects[door].door_share, 0);
  world.run(1.5);
  EXPECT_EQ(world.objects[door].door_share, 1);
  world.run(4);
  EXPECT_NEAR(world.poses[robot].x, -2 + 7.5 * 0.5, 1e-9) << "it was not stopped";
  EXPECT_EQ(world.objects[door].door_share, 0);
}

TEST(Door, StopsARobotWhenItIsClosed) {
  ObjectWorld world;
  world.addDoor({0, 0, M_PI_2}, 1, {.slide_m = 1});
  const auto robot = world.addRobot({-2, 0, 0}, 0.5);
  world.run(5);
  EXPECT_TRUE(world.is_blocked[robot]);
  EXPECT_NEAR(world.poses[robot].x, -0.05 - 0.25, 1e-4);
  EXPECT_EQ(world.deepestOverlap(), 0);
}

TEST(Door, IsHeldOpenByARobotAndDoesNotPushIt) {
  ObjectWorld world;
  const auto door = world.addDoor({0, 0, M_PI_2}, 1, {.slide_m = 1, .speed = 0.5, .share = 1});
  const auto robot = world.addRobot({0, 0, 0}, 0);
  world.run(4);
  // The near end of the closing door comes from y = 0.5 m to the robot's rim at 0.25 m.
  EXPECT_NEAR(world.objects[door].door_share, 0.75, 1e-3);
  EXPECT_EQ(world.poses[robot], mrpt::math::TPose2D(0, 0, 0));
  EXPECT_EQ(world.deepestOverlap(), 0);
  world.poses[robot].x = 2;
  world.run(4);
  EXPECT_EQ(world.objects[door].door_share, 0);
}

TEST(Door, DoesNotStopARobotThatDrivesAheadOfIt) {
  ObjectWorld world;
  const auto door = world.addDoor({0, 0, M_PI_2}, 1, {.slide_m = 2, .speed = 0.5, .share = 1});
  // The closing door comes down behind the robot, faster than it drives.
  const auto robot = world.addRobot({0, 1.2, -M_PI_2}, 0.2);
  world.run(3);
  EXPECT_FALSE(world.is_blocked[robot]);
  EXPECT_NEAR(world.poses[robot].y, 1.2 - 3 * 0.2, 1e-9);
  EXPECT_GT(world.objects[door].door_share, 0.3) << "the robot holds it";
  EXPECT_EQ(world.deepestOverlap(), 0);
}

TEST(Door, PushesABoxAside) {
  ObjectWorld world;
  world.addDoor({0, 0, M_PI_2}, 1, {.slide_m = -1, .speed = 0.5, .open_to = 1});
  const auto box = world.addBox({0, -0.9, 0}, 0.4, 0.4, {.mass_kg = 50});
  world.run(4);
  // When the door stops, the box slides on by v² / (2 μ g).
  EXPECT_NEAR(world.at(box).y, -1 - 0.5 - 0.2 - 0.5 * 0.5 / (2 * 0.5 * 9.81), 1e-5);
  EXPECT_EQ(world.deepestOverlap(), 0);
}

TEST(Door, MayBeInAWall) {
  ObjectWorld world;
  world.addWall({0, 1, M_PI_2}, 1, 0.2);
  const auto door = world.addDoor({0, 0, M_PI_2}, 1, {.slide_m = 1, .speed = 1, .open_to = 1});
  world.run(2);
  EXPECT_EQ(world.objects[door].door_share, 1);
}

}  // namespace
}  // namespace robosim
