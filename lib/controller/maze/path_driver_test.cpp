#include "maze/path_driver.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

struct PathDriverTest : testing::Test {
  PathDriverTest() { map.cover({-40, -40}, {40, 40}); }
  void steps(int n) {
    for (int i = 0; i < n; ++i) {
      driver.drive(robot, hardware.odometry().odom_from_robot, map);
      hardware.advance();
    }
  }
  const mrpt::math::TPose2D& pose() const { return hardware.odometry().odom_from_robot; }

  FakeHardware hardware;
  Robot robot{hardware};
  MazeMap map{0.15};
  PathDriver driver;
};

std::vector<Cell> straight(int from, int to) {
  std::vector<Cell> path;
  for (int x = from; x <= to; ++x) path.push_back({x, 0});
  return path;
}

TEST_F(PathDriverTest, DrivesToTheGoal) {
  driver.follow(straight(0, 20));
  steps(100);
  EXPECT_NEAR(pose().x, 20.5 * 0.15, 0.1);
  EXPECT_NEAR(pose().y, 0.075, 0.05);
  EXPECT_EQ(hardware.odometry().speed_mps, 0);
}

TEST_F(PathDriverTest, TurnsBeforeItDrives) {
  driver.follow({{-1, 0}, {-2, 0}, {-3, 0}, {-4, 0}, {-5, 0}});
  steps(5);
  EXPECT_NEAR(pose().x, 0, 1e-9);
  EXPECT_GT(std::abs(pose().phi), 0.3);
  steps(60);
  EXPECT_NEAR(pose().x, -4.5 * 0.15, 0.1);
}

TEST_F(PathDriverTest, StaysOnThePathAroundACorner) {
  // Walls are close to all cells, so that there is no shortcut.
  for (std::size_t i = 0; i < map.size(); ++i) map.at(i).walls_close = 1;
  std::vector<Cell> path = straight(0, 15);
  for (int y = 1; y <= 15; ++y) path.push_back({15, y});
  driver.follow(path);
  for (int i = 0; i < 150; ++i) {
    steps(1);
    const double off = std::min(std::hypot(pose().x - std::clamp(pose().x, 0.0, 15.5 * 0.15), pose().y - 0.075),
                                std::hypot(pose().x - 15.5 * 0.15, pose().y - std::clamp(pose().y, 0.0, 15.5 * 0.15)));
    EXPECT_LT(off, 0.3);
  }
  EXPECT_NEAR(pose().y, 15.5 * 0.15, 0.3);
}

TEST_F(PathDriverTest, TakesAShortcutThroughFreeSpace) {
  std::vector<Cell> path = straight(0, 6);
  for (int y = 1; y <= 6; ++y) path.push_back({6, y});
  driver.follow(path);
  driver.drive(robot, {0.075, 0.075, M_PI / 4}, map);
  // Eight cells ahead, the path is at (6, 2): 18° left of the x axis, 27° right of the heading.
  EXPECT_NEAR(hardware.lastCommand().turn_radps, 2.5 * (std::atan2(2, 6) - M_PI / 4), 1e-9);
}

TEST_F(PathDriverTest, StopsBeforeAnObstacleThatTheMapLacks) {
  // A wall 1 m ahead that the map does not contain.
  hardware.sense = [](FakeHardware& h) { h.setSonarRange(0, 1.0 - h.odometry().odom_from_robot.x); };
  driver.follow(straight(0, 30));
  steps(100);
  EXPECT_GT(pose().x, 0.7);
  EXPECT_LE(pose().x, 0.951);
  EXPECT_NEAR(hardware.odometry().speed_mps, 0, 0.05);
}

TEST_F(PathDriverTest, ConsidersOnlyObstaclesInItsLane) {
  hardware.setSonarRange(4, 0.02);  // walls on both sides
  hardware.setSonarRange(12, 0.02);
  EXPECT_EQ(clearanceInLane(robot, 1), std::numeric_limits<double>::infinity());
  hardware.setSonarRange(0, 0.6);
  hardware.setSonarRange(8, 0.4);
  EXPECT_NEAR(clearanceInLane(robot, 1), 0.6, 1e-6);
  EXPECT_NEAR(clearanceInLane(robot, -1), 0.4, 1e-6);
  // At 22.5° and 0.45 m from the centre: 0.416 m ahead and 0.172 m to the side, where the disc extends 0.181 m ahead.
  hardware.setSonarRange(1, 0.2);
  EXPECT_NEAR(clearanceInLane(robot, 1), 0.4157 - 0.1813, 1e-3);
}

TEST_F(PathDriverTest, DetectsABlockedPath) {
  driver.follow(straight(0, 20));
  EXPECT_FALSE(driver.blocked(map));
  map[{10, 0}].walls_near = 1;
  EXPECT_TRUE(driver.blocked(map));
  map[{10, 0}].walls_near = 0;
  map[{1, 0}].walls_near = 1;  // behind the next cell: irrelevant
  EXPECT_FALSE(driver.blocked(map));
}

}  // namespace
}  // namespace robosim
