#include "dynamics/pushing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "dynamics/testing/object_world.h"

namespace robosim {
namespace {

constexpr double kNear_m = 5e-6;  ///< a few contact gaps

TEST(MeanDistance, IsTwoThirdsOfADiscsRadiusAndThatOfASquare) {
  EXPECT_DOUBLE_EQ(meanDistance(Cylinder{0.3}), 0.2);
  // Of a square with sides of 2 a: a (√2 + ln(1 + √2)) / 3.
  EXPECT_NEAR(meanDistance(Cube{2, 2}), (std::sqrt(2) + std::log(1 + std::sqrt(2))) / 3, 1e-12);
  EXPECT_NEAR(meanDistance(Cube{2, 1e-6}), 0.5, 1e-9) << "a rod";
}

TEST(Pushing, MovesABoxThatIsPushedInLineWithTheRobot) {
  ObjectWorld world;
  const auto robot = world.addRobot({0, 0, 0}, 0.5);
  const auto box = world.addBox({0.55, 0, 0}, 0.4, 0.4);  // 0.1 m ahead
  world.run(2);
  EXPECT_NEAR(world.poses[robot].x, 1, 1e-12);
  EXPECT_NEAR(world.at(box).x, 1 + 0.25 + 0.2, kNear_m);
  EXPECT_EQ(world.at(box).y, 0);
  EXPECT_EQ(world.at(box).phi, 0);
  EXPECT_FALSE(world.is_blocked[robot]);
}

TEST(Pushing, TurnsABoxThatIsPushedOffCentreAsTheLimitSurfacePredicts) {
  ObjectWorld world;
  world.addRobot({-0.45 - 2e-6, -0.1, 0}, 0.01);
  const auto box = world.addBox({0, 0, 0}, 0.4, 0.6);
  world.step();
  // The force acts along x at the lever arm 0.1 m: the speeds along (x, turn) are as (1, arm / c²), and the point of
  // contact moves with the robot: x + arm · turn = 1 mm.
  const double c = meanDistance(Cube{0.4, 0.6});
  const double x_m = 0.001 / (1 + 0.1 * 0.1 / (c * c));
  EXPECT_NEAR(world.at(box).x, x_m, 0.005 * x_m);
  EXPECT_NEAR(world.at(box).phi, x_m * 0.1 / (c * c), 0.005 * x_m * 0.1 / (c * c));
  EXPECT_NEAR(world.at(box).y, 0, 1e-5);
}

TEST(Pushing, LetsABoxThatIsPushedSidewaysSlideOffTheRobot) {
  ObjectWorld world;
  world.addRobot({0, 0, 0}, 0.5);
  const auto box = world.addBox({0.5, 0.35, 0}, 0.4, 0.4);
  world.run(4);
  EXPECT_GT(world.at(box).y, 0.4);
  EXPECT_EQ(world.deepestOverlap(), 0);
}

TEST(Pushing, DeceleratesABallByItsFriction) {
  ObjectWorld world;
  const auto ball = world.addDisc({0, 0, 0}, 0.1, {.mass_kg = 0.4, .friction = 0.05});
  world.objects[ball].vx_mps = 1;
  world.step(0.5);
  EXPECT_NEAR(world.objects[ball].vx_mps, 1 - 0.5 * 0.05 * 9.81, 1e-9);
  EXPECT_NEAR(world.at(ball).x, 0.5 - 0.5 * 0.05 * 9.81 * 0.25, 1e-9);
  world.run(5);
  EXPECT_TRUE(world.objects[ball].isAtRest());
  EXPECT_NEAR(world.at(ball).x, 1 / (2 * 0.05 * 9.81), 1e-9);
}

TEST(Pushing, BouncesABallWithItsRestitution) {
  ObjectWorld world;
  world.addWall({1.5, 0, 0}, 1, 2);
  const auto ball = world.addDisc({0, 0, 0}, 0.1, {.mass_kg = 0.4, .friction = 0, .restitution = 0.5});
  world.objects[ball].vx_mps = 1;
  world.objects[ball].vy_mps = 0.2;
  world.run(1.5);
  EXPECT_NEAR(world.objects[ball].vx_mps, -0.5, 1e-12);
  EXPECT_NEAR(world.objects[ball].vy_mps, 0.2, 1e-12);
  // It meets the wall with its centre at 0.9 m after 0.9 s; where it waits there for the next part of the step.
  EXPECT_NEAR(world.at(ball).x, 0.9 - 0.5 * 0.6, Pushing::kPart_s * 1);
  EXPECT_NEAR(world.at(ball).y, 0.2 * 1.5, 1e-9);
}

TEST(Pushing, PassesTheSpeedOfABallOnToAnEqualOne) {
  ObjectWorld world;
  const Movable elastic{.mass_kg = 0.2, .friction = 0, .restitution = 1};
  const auto first = world.addDisc({0, 0, 0}, 0.1, elastic);
  const auto second = world.addDisc({0.5, 0, 0}, 0.1, elastic);
  const auto third = world.addDisc({0.7 + 1e-6, 0, 0}, 0.1, elastic);
  world.objects[first].vx_mps = 1;
  world.run(1);
  EXPECT_NEAR(world.objects[first].vx_mps, 0, 1e-12);
  EXPECT_NEAR(world.objects[second].vx_mps, 0, 1e-12);
  EXPECT_NEAR(world.objects[third].vx_mps, 1, 1e-12);
}

TEST(Pushing, BouncesABallOffARobotThatComesTowardsIt) {
  ObjectWorld world;
  world.addRobot({0, 0, 0}, 1);
  const auto ball = world.addDisc({1, 0, 0}, 0.1, {.mass_kg = 0.4, .friction = 0, .restitution = 1});
  world.objects[ball].vx_mps = -1;
  world.run(1);
  EXPECT_NEAR(world.objects[ball].vx_mps, 3, 1e-9) << "2 m/s of approach become 2 m/s of separation";
}

TEST(Pushing, DoesNotStopARobotThatDrivesAwayFromAJam) {
  // A pushes a box against B, which drives slowly in the same direction.
  ObjectWorld world;
  world.addRobot({0, 0, 0}, 0.5);
  world.addBox({0.5, 0, 0}, 0.4, 0.4);
  const auto ahead = world.addRobot({0.96, 0, 0}, 0.2);
  world.run(2);
  EXPECT_NEAR(world.poses[ahead].x, 0.96 + 0.4, 1e-9);
  EXPECT_TRUE(world.is_blocked[0]);
}

TEST(Pushing, PushesThreeBoxesInARow) {
  ObjectWorld world;
  world.addRobot({0, 0, 0}, 0.3);
  std::vector<std::size_t> boxes;
  for (const double x : {0.6, 1.2, 1.7}) boxes.push_back(world.addBox({x, 0, 0}, 0.4, 0.4));
  world.run(5);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(world.at(boxes[i]).x, 1.5 + 0.25 + 0.2 + 0.4 * static_cast<double>(i), 3 * kNear_m) << i;
    EXPECT_NEAR(world.at(boxes[i]).y, 0, kNear_m) << i;
    EXPECT_NEAR(world.at(boxes[i]).phi, 0, 1e-5) << i;
  }
}

TEST(Pushing, BlocksARobotWhoseBoxIsAtAWall) {
  ObjectWorld world;
  world.addWall({2, 0, 0}, 1, 3);  // from 1.5 m
  const auto robot = world.addRobot({0, 0, 0}, 0.5);
  const auto box = world.addBox({0.6, 0, 0}, 0.4, 0.4);
  world.run(4);
  EXPECT_TRUE(world.is_blocked[robot]);
  const double left_m = 0.5 * Pushing::kPart_s / (1 << Pushing::kHalvings) + 4 * kNear_m;
  EXPECT_NEAR(world.at(box).x, 1.3, left_m);
  EXPECT_NEAR(world.poses[robot].x, 1.3 - 0.2 - 0.25, left_m);
  EXPECT_EQ(world.deepestOverlap(), 0);
}

TEST(Pushing, BlocksARobotThatIsTooWeak) {
  ObjectWorld world;
  const Movable heavy{.mass_kg = 10, .friction = 0.5};  // 49.05 N
  const auto strong = world.addRobot({0, 0, 0}, 0.3, 49.1);
  const auto weak = world.addRobot({0, 3, 0}, 0.3, 49);
  const auto of_strong = world.addBox({0.6, 0, 0}, 0.4, 0.4, heavy);
  const auto of_weak = world.addBox({0.6, 3, 0}, 0.4, 0.4, heavy);
  world.run(2);
  EXPECT_FALSE(world.is_blocked[strong]);
  EXPECT_NEAR(world.at(of_strong).x, 0.6 + 0.45, kNear_m);
  EXPECT_TRUE(world.is_blocked[weak]);
  EXPECT_NEAR(world.at(of_weak).x, 0.6, kNear_m);
}

TEST(Pushing, MovesWithTwoRobotsWhatOneCannotMove) {
  ObjectWorld world;
  const Movable heavy{.mass_kg = 10, .friction = 0.5};  // 49.05 N
  for (const double y : {-0.5, 0.5}) world.addRobot({0, y, 0}, 0.3, 30);
  const auto box = world.addBox({0.6, 0, 0}, 0.4, 2, heavy);
  world.speeds_mps[1] = 0;
  world.run(1);
  const double turned_rad = std::abs(world.at(box).phi);
  EXPECT_LT(turned_rad, 0.2) << "one alone turns it only";
  world = ObjectWorld();
  for (const double y : {-0.5, 0.5}) world.addRobot({0, y, 0}, 0.3, 30);
  world.addBox({0.6, 0, 0}, 0.4, 2, heavy);
  world.run(2);
  EXPECT_NEAR(world.at(box).x, 0.6 + 0.45, kNear_m);
  EXPECT_NEAR(world.at(box).phi, 0, 1e-6);
}

TEST(Pushing, KeepsObjectsOnTheSurface) {
  ObjectWorld world({-1, 1, -1, 1});
  const auto ball = world.addDisc({0, 0, 0}, 0.1, {.mass_kg = 0.4, .friction = 0, .restitution = 1});
  world.objects[ball].vx_mps = 3;
  world.objects[ball].vy_mps = 2;
  for (int i = 0; i < 100; ++i) {
    world.step();
    ASSERT_EQ(world.deepestOverlap(), 0) << i;
  }
  EXPECT_NEAR(world.energy(), 0.4 / 2 * 13, 1e-9);
}

TEST(Pushing, LetsNothingPassThroughAThinWall) {
  ObjectWorld world;
  world.addWall({1, 0, 0}, 0.001, 5);
  const auto ball = world.addDisc({0, 0, 0}, 0.02, {.mass_kg = 0.1, .friction = 0, .restitution = 0.9});
  world.objects[ball].vx_mps = 8;
  for (int i = 0; i < 4; ++i) {
    world.step();
    ASSERT_LT(world.at(ball).x, 1) << i;
  }
  EXPECT_NEAR(world.objects[ball].vx_mps, -7.2, 1e-9);
}

TEST(Pushing, LeavesObjectsAtOtherHeightsAlone) {
  ObjectWorld world;
  world.addRobot({0, 0, 0}, 0.5);
  const auto shelf = world.addBox({0.6, 0, 0}, 0.4, 0.4);
  world.bodies[shelf].heights = {0.5, 1};
  world.run(2);
  EXPECT_EQ(world.at(shelf).x, 0.6);
}

}  // namespace
}  // namespace robosim
