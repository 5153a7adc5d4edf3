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
  std::vector<Cell> way;
  for (int x = from; x <= to; ++x) way.push_back({x, 0});
  return way;
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

TEST_F(PathDriverTest, KeepsToTheWayRoundACorner) {
  // Walls are close everywhere but on the way, so that no shortcut is to be had.
  for (std::size_t i = 0; i < map.size(); ++i) map.at(i).walls_close = 1;
  std::vector<Cell> way = straight(0, 15);
  for (int y = 1; y <= 15; ++y) way.push_back({15, y});
  driver.follow(way);
  for (int i = 0; i < 150; ++i) {
    steps(1);
    const double off = std::min(std::hypot(pose().x - std::clamp(pose().x, 0.0, 15.5 * 0.15), pose().y - 0.075),
                                std::hypot(pose().x - 15.5 * 0.15, pose().y - std::clamp(pose().y, 0.0, 15.5 * 0.15)));
    EXPECT_LT(off, 0.3);
  }
  EXPECT_NEAR(pose().y, 15.5 * 0.15, 0.3);
}

TEST_F(PathDriverTest, TakesTheStraightLineWhereThereIsRoom) {
  std::vector<Cell> way = straight(0, 6);
  for (int y = 1; y <= 6; ++y) way.push_back({6, y});
  driver.follow(way);
  driver.drive(robot, {0.075, 0.075, M_PI / 4}, map);
  // Eight cells on, the way is at (6, 2): 18° left of straight ahead along x, 27° right of where it looks.
  EXPECT_NEAR(hardware.lastCommand().turn_radps, 2.5 * (std::atan2(2, 6) - M_PI / 4), 1e-9);
}

TEST_F(PathDriverTest, StopsBeforeWhatIsInFront) {
  // A wall a metre ahead, of which the map knows nothing.
  hardware.sense = [](FakeHardware& h) { h.setSonarRange(0, 1.0 - h.odometry().odom_from_robot.x); };
  driver.follow(straight(0, 30));
  steps(100);
  EXPECT_GT(pose().x, 0.7);
  EXPECT_LE(pose().x, 0.951);
  EXPECT_NEAR(hardware.odometry().speed_mps, 0, 0.05);
}

TEST_F(PathDriverTest, MindsOnlyWhatIsInItsLane) {
  hardware.setSonarRange(4, 0.02);  // a wall beside it
  hardware.setSonarRange(12, 0.02);
  EXPECT_EQ(roomInLane(robot, 1), std::numeric_limits<double>::infinity());
  hardware.setSonarRange(0, 0.6);
  hardware.setSonarRange(8, 0.4);
  EXPECT_NEAR(roomInLane(robot, 1), 0.6, 1e-6);
  EXPECT_NEAR(roomInLane(robot, -1), 0.4, 1e-6);
  // At 22.5° and 0.45 m from the centre: 0.416 ahead, 0.172 aside, where the disc reaches 0.181 less far ahead.
  hardware.setSonarRange(1, 0.2);
  EXPECT_NEAR(roomInLane(robot, 1), 0.4157 - 0.1813, 1e-3);
}

TEST_F(PathDriverTest, SeesThatTheWayIsBlocked) {
  driver.follow(straight(0, 20));
  EXPECT_FALSE(driver.blocked(map));
  map[{10, 0}].walls_near = 1;
  EXPECT_TRUE(driver.blocked(map));
  map[{10, 0}].walls_near = 0;
  map[{1, 0}].walls_near = 1;  // where it is about to leave
  EXPECT_FALSE(driver.blocked(map));
}

}  // namespace
}  // namespace robosim
