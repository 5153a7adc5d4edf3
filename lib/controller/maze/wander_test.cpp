#include "maze/wander.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

TEST(Wander, DrivesStraightWithoutObstacles) {
  FakeHardware hardware;
  Robot robot(hardware);
  Wander wander({.seed = 1});
  for (int i = 0; i < 50; ++i) {
    wander.step(robot);
    hardware.advance();
  }
  EXPECT_NEAR(hardware.odometry().speed_mps, 1, 1e-9);
}

TEST(Wander, TurnsAwayFromTheNearerSide) {
  for (const std::size_t near : {1u, 15u}) {  // 22.5° left, right
    FakeHardware hardware;
    Robot robot(hardware);
    hardware.setSonarRange(near, 0.2);
    Wander wander({.seed = 1});
    wander.step(robot);
    EXPECT_EQ(robot.command().turn_radps < 0, near == 1) << "an obstacle at sonar " << near;
  }
}

TEST(Wander, VisitsAllPartsOfARoomAndRarelyStalls) {
  FakeMaze maze(FakeMaze::room(-3, 3, -3, 3), {99, 99}, 0);
  Robot robot(maze.hardware);
  Wander wander({.seed = 2});
  int stalls = 0;
  bool been[3][3] = {};
  for (int i = 0; i < 6000; ++i) {
    wander.step(robot);
    maze.hardware.advance();
    stalls += robot.stalled();
    const auto part = [](double x) { return std::clamp(static_cast<int>(std::floor((x + 3) / 2)), 0, 2); };
    been[part(maze.pose().x)][part(maze.pose().y)] = true;
  }
  EXPECT_LT(stalls, 60);
  for (const auto& column : been) {
    for (const bool here : column) EXPECT_TRUE(here);
  }
}

TEST(Wander, OfDifferentRobotsTakesDifferentPaths) {
  FakeMaze one(FakeMaze::room(-3, 3, -3, 3), {99, 99}, 0), other(FakeMaze::room(-3, 3, -3, 3), {99, 99}, 0);
  Robot robot(one.hardware), other_robot(other.hardware);
  Wander wander({.seed = 2, .robot = 0}), other_wander({.seed = 2, .robot = 1});
  for (int i = 0; i < 500; ++i) {
    wander.step(robot);
    other_wander.step(other_robot);
    one.hardware.advance();
    other.hardware.advance();
  }
  EXPECT_GT(std::hypot(one.pose().x - other.pose().x, one.pose().y - other.pose().y), 0.1);
}

TEST(Wander, WithoutSonarContinues) {
  FakeHardware hardware(0);
  Robot robot(hardware);
  Wander wander({.seed = 1});
  EXPECT_NO_THROW(wander.step(robot));
}

}  // namespace
}  // namespace robosim
