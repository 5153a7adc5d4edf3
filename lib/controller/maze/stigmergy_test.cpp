#include "maze/stigmergy.h"

#include <set>

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

const mrpt::math::TPose2D kCellStart(0.4, 0.4, 0);  // in the middle of cell (0, 0) of 0.8 m

TEST(ClearanceTowards, IsTheDistanceFromTheRobotsEdgeInThatLane) {
  FakeHardware hardware;
  const Robot robot(hardware);
  hardware.setSonarRange(4, 1.5);  // of 16: to the left
  EXPECT_NEAR(clearanceTowards(robot, M_PI / 2), 1.5, 1e-6);
  EXPECT_TRUE(std::isinf(clearanceTowards(robot, -M_PI / 2)));
}

TEST(Stigmergy, MarksTheCellsThatItEnters) {
  FakeHardware hardware;
  hardware.robot_names = {"fake", "other", "third"};
  Robot robot(hardware);
  Stigmergy controller({.world_from_start = kCellStart});
  controller.step(robot);
  ASSERT_EQ(hardware.sent.size(), 2u);
  EXPECT_EQ(hardware.sent[0], (RobotMessage{"fake", "other", "TRAIL 0 0"}));
  EXPECT_EQ(hardware.sent[1], (RobotMessage{"fake", "third", "TRAIL 0 0"}));
  for (int i = 0; i < 3; ++i) {
    hardware.advance();
    controller.step(robot);
  }
  EXPECT_EQ(hardware.sent.size(), 2u) << "it is still in the cell";
}

/// Heading [rad] of a robot at kCellStart after its first turn, if these cells were visited by another robot.
double headingAfter(const std::vector<Cell>& visited, const std::vector<std::size_t>& blocked_sonars = {}) {
  FakeHardware hardware;
  hardware.robot_names = {"fake", "other"};
  for (const auto sonar : blocked_sonars) hardware.setSonarRange(sonar, 0.2);
  Robot robot(hardware);
  Stigmergy controller({.world_from_start = kCellStart});
  for (const auto& cell : visited) {
    hardware.mutableReadings().inbox.edit().push_back({"other", "fake", TrailMessage{cell}.text()});
  }
  for (int i = 0; i < 40; ++i) {
    controller.step(robot);
    hardware.advance();
    if (hardware.lastCommand().speed_mps > 0) break;
  }
  return hardware.odometry().odom_from_robot.phi;
}

TEST(Stigmergy, DrivesToTheCellWithoutPheromone) {
  EXPECT_NEAR(headingAfter({}), 0, 0.1) << "ahead, of equal ones";
  // All cells around but the upper one.
  const double phi = headingAfter({{1, 0}, {1, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}});
  EXPECT_NEAR(phi, M_PI / 2, M_PI / 4);
}

TEST(Stigmergy, AvoidsBlockedDirections) {
  const double phi = headingAfter({}, {0, 1, 2, 15, 14});
  EXPECT_GT(std::abs(phi), 0.8);
}

TEST(Stigmergy, WithoutItsStartIgnoresMessagesAndSendsNone) {
  FakeHardware hardware;
  hardware.robot_names = {"fake", "other"};
  Robot robot(hardware);
  Stigmergy controller({});
  hardware.mutableReadings().inbox.edit().push_back({"other", "fake", "TRAIL 1 0"});
  controller.step(robot);
  EXPECT_TRUE(hardware.sent.empty());
}

TEST(Stigmergy, VisitsAllOfARoom) {
  FakeMaze maze(FakeMaze::room(-3.2, 3.2, -2.4, 2.4), {99, 99}, 0);
  Robot robot(maze.hardware);
  Stigmergy controller({.seed = 2});
  std::set<std::pair<int, int>> cells;
  for (int i = 0; i < 3000; ++i) {
    controller.step(robot);
    maze.hardware.advance();
    cells.insert(
        {static_cast<int>(std::floor(maze.pose().x / 0.8)), static_cast<int>(std::floor(maze.pose().y / 0.8))});
  }
  EXPECT_GE(cells.size(), 44u) << "of 8 × 6";
}

}  // namespace
}  // namespace robosim
