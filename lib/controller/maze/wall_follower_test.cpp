#include "maze/wall_follower.h"

#include <cmath>

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

constexpr double kDistance_m = 1.5 * FakeHardware::kRadius_m;  // from the robot's edge; the default

TEST(WallFollower, DrivesStraightWithoutAWall) {
  FakeHardware hardware;
  Robot robot(hardware);
  WallFollower follower;
  for (int i = 0; i < 30; ++i) {
    follower.step(robot);
    hardware.advance();
  }
  EXPECT_GT(hardware.odometry().speed_mps, 0.5);
  EXPECT_EQ(hardware.odometry().odom_from_robot.phi, 0);
}

TEST(WallFollower, KeepsItsDistanceToTheWallOnTheRight) {
  FakeMaze maze({FakeMaze::box(0, -0.8, 100, 0.1)}, {99, 99}, 0);
  Robot robot(maze.hardware);
  WallFollower follower;
  for (int i = 0; i < 300; ++i) {
    follower.step(robot);
    maze.hardware.advance();
    if (i > 150) {
      EXPECT_NEAR(maze.pose().y - FakeHardware::kRadius_m + 0.75, kDistance_m, 0.1);
    }
  }
  EXPECT_GT(maze.pose().x, 5);
}

TEST(WallFollower, FollowsTheWallsOfARoomCounterClockwise) {
  FakeMaze maze(FakeMaze::room(-2, 2, -2, 2), {99, 99}, 0);
  Robot robot(maze.hardware);
  WallFollower follower;
  double angle = 0;
  mrpt::math::TPoint2D last(1, 0);
  for (int i = 0; i < 1500; ++i) {
    follower.step(robot);
    maze.hardware.advance();
    EXPECT_FALSE(robot.stalled());
    const mrpt::math::TPoint2D now(maze.pose().x, maze.pose().y);
    if (now.norm() > 0.5) {
      angle += std::atan2(last.x * now.y - last.y * now.x, last.x * now.x + last.y * now.y);
      last = now;
    }
  }
  EXPECT_GT(angle, 4 * M_PI);  // at least two turns
}

TEST(WallFollower, FollowsOuterCorners) {
  // A block of 2 m: the robot follows it clockwise, at a small distance.
  FakeMaze maze({FakeMaze::box(2.5, 0, 2, 2)}, {99, 99}, 0);
  Robot robot(maze.hardware);
  WallFollower follower;
  double angle = 0;
  mrpt::math::TPoint2D last(-1, 0);
  for (int i = 0; i < 1200; ++i) {
    follower.step(robot);
    maze.hardware.advance();
    const mrpt::math::TPoint2D now(maze.pose().x - 2.5, maze.pose().y);
    angle += std::atan2(last.x * now.y - last.y * now.x, last.x * now.x + last.y * now.y);
    last = now;
    if (i > 100) {
      EXPECT_LT(distance(FakeMaze::box(0, 0, 2, 2), now), 1.5);
    }
  }
  EXPECT_LT(angle, -2 * M_PI);
}

TEST(WallFollower, FollowsAThinWallRoundAndRound) {
  // Of 8 sonars none detects the wall while the robot turns around its ends, in an arc.
  const auto wall = FakeMaze::box(1.5, 0, 0.1, 2);
  FakeMaze maze({wall}, {99, 99}, 0, 8);
  Robot robot(maze.hardware);
  WallFollower follower;
  double angle = 0;
  mrpt::math::TPoint2D last(-1.5, 0);
  for (int i = 0; i < 3000 && angle > -6 * M_PI; ++i) {
    follower.step(robot);
    maze.hardware.advance();
    const mrpt::math::TPoint2D now(maze.pose().x - 1.5, maze.pose().y);
    angle += std::atan2(last.x * now.y - last.y * now.x, last.x * now.x + last.y * now.y);
    last = now;
    ASSERT_LT(distance(wall, {maze.pose().x, maze.pose().y}), 1.5) << i;
  }
  EXPECT_LE(angle, -6 * M_PI) << "three rounds";
}

TEST(WallFollower, KeepsTheDistanceOfItsOptions) {
  FakeMaze maze({FakeMaze::box(0, -0.8, 100, 0.1)}, {99, 99}, 0);
  Robot robot(maze.hardware);
  WallFollower follower({}, {.distance_radii = 1});
  for (int i = 0; i < 300; ++i) {
    follower.step(robot);
    maze.hardware.advance();
  }
  EXPECT_NEAR(maze.pose().y - FakeHardware::kRadius_m + 0.75, FakeHardware::kRadius_m, 0.1);
}

}  // namespace
}  // namespace robosim
