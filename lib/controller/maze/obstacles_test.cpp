#include "maze/obstacles.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

struct ObstaclesTest : testing::Test {
  ObstaclesTest() { map.cover({-60, -60}, {60, 60}); }
  void look(const mrpt::math::TPose2D& pose = {}) {
    obstacles.look(pose, (*hardware.info().sensors)[1], std::get<Echoes>(hardware.readings().measurements[1]));
  }
  bool occupied(double x, double y) const { return map[map.cellAt({x, y})].evidence > 2; }
  bool blocked(double x, double y) const { return map[map.cellAt({x, y})].blocked(); }

  FakeHardware hardware;
  MazeMap map{0.15};
  Obstacles obstacles{map, FakeHardware::kRadius_m};
};

TEST_F(ObstaclesTest, AreCreatedAtTheEndsOfEchoes) {
  hardware.setSonarRange(0, 1.0);  // from the robot's edge: 1.25 m ahead of its centre
  look();
  EXPECT_TRUE(occupied(1.27, 0.05));
  EXPECT_FALSE(occupied(1.05, 0.05));
  EXPECT_FALSE(occupied(1.6, 0.05));
  look({2, 1, M_PI / 2});
  EXPECT_TRUE(occupied(1.95, 2.27));
}

TEST_F(ObstaclesTest, BlockCellsWithinTheRobotsRadius) {
  hardware.setSonarRange(0, 1.0);
  look();
  EXPECT_TRUE(blocked(1.27, 0.05));
  EXPECT_TRUE(blocked(1.12, 0.05));
  EXPECT_FALSE(blocked(0.9, 0.05));
  EXPECT_GT(map[map.cellAt({0.9, 0.05})].walls_close, 0);
  EXPECT_EQ(map[map.cellAt({0.5, 0.05})].walls_close, 0);
}

TEST_F(ObstaclesTest, AreNotCreatedWithoutEchoes) {
  look();
  EXPECT_EQ(obstacles.changes(), 0u);
}

TEST_F(ObstaclesTest, AreRemovedAfterRepeatedMeasurementsOfFreeSpace) {
  hardware.setSonarRange(0, 1.0);
  for (int i = 0; i < 5; ++i) look();
  hardware.clearEchoes();
  look();
  EXPECT_TRUE(occupied(1.27, 0.05));  // after five detections, one measurement does not remove it
  for (int i = 0; i < 10; ++i) look();
  EXPECT_FALSE(occupied(1.27, 0.05));
  EXPECT_FALSE(blocked(1.27, 0.05));
}

TEST_F(ObstaclesTest, RemainIfDetectedInEveryThirdMeasurement) {
  for (int i = 0; i < 30; ++i) {
    hardware.setSonarRange(0, i % 3 == 0 ? 1.0 : 3.0);
    look();
  }
  EXPECT_TRUE(occupied(1.27, 0.05));
}

TEST_F(ObstaclesTest, BeyondTheMaximumRangeAreIgnored) {
  hardware.setSonarRange(0, 4.5);  // 30 cells
  look();
  EXPECT_EQ(obstacles.changes(), 0u);
}

TEST_F(ObstaclesTest, AreCreatedFromEveryNthBeam) {
  hardware.setSonarRange(1, 1.0);
  hardware.setSonarRange(2, 1.0);
  obstacles.look({}, (*hardware.info().sensors)[1], std::get<Echoes>(hardware.readings().measurements[1]), 2);
  EXPECT_EQ(obstacles.changes(), 1u);
}

TEST_F(ObstaclesTest, AreRemovedUnderTheRobot) {
  hardware.setSonarRange(0, 1.0);
  look();
  obstacles.clearUnder({1.27, 0.05});
  EXPECT_FALSE(occupied(1.27, 0.05));
}

TEST_F(ObstaclesTest, OfACollisionBlockCells) {
  obstacles.bump({0.5, 0.5});
  EXPECT_TRUE(blocked(0.5, 0.5));
}

TEST_F(ObstaclesTest, TooLowForTheSonarStayAfterThreeCollisions) {
  const auto bumpAndLook = [&] {
    obstacles.bump({0.8, 0.05});
    hardware.setSonarRange(0, 3.0);  // above the obstacle
    for (int i = 0; i < 20; ++i) look();
  };
  bumpAndLook();
  EXPECT_FALSE(occupied(0.8, 0.05));
  bumpAndLook();
  EXPECT_FALSE(occupied(0.8, 0.05));
  bumpAndLook();
  EXPECT_TRUE(occupied(0.8, 0.05));
}

TEST_F(ObstaclesTest, OfThreeCollisionsAreRemovedUnderTheRobotAndAsUncertain) {
  const auto bump3 = [&] {
    for (int i = 0; i < 3; ++i) obstacles.bump({0.8, 0.05});
  };
  hardware.setSonarRange(0, 3.0);
  bump3();
  obstacles.clearUnder({0.8, 0.05});
  obstacles.bump({0.8, 0.05});  // a first collision again
  for (int i = 0; i < 20; ++i) look();
  EXPECT_FALSE(occupied(0.8, 0.05));
  bump3();
  obstacles.removeUncertain();
  EXPECT_FALSE(occupied(0.8, 0.05));
}

TEST_F(ObstaclesTest, DetectedOnceAreRemovedAsUncertain) {
  hardware.setSonarRange(0, 1.0);
  look();
  look();
  hardware.setSonarRange(8, 1.0);  // straight backwards
  look();
  obstacles.bump({0.5, 0.5});
  obstacles.removeUncertain();
  EXPECT_TRUE(occupied(1.27, 0.05));
  EXPECT_FALSE(occupied(-1.27, 0.05));
  EXPECT_FALSE(blocked(0.5, 0.5));
}

TEST_F(ObstaclesTest, AreCountedAroundEachCell) {
  Rng rng(7);
  for (int i = 0; i < 500; ++i) {
    for (std::size_t beam = 0; beam < 16; ++beam) hardware.setSonarRange(beam, rng.uniform(0.1, 6));
    const mrpt::math::TPose2D pose(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-3, 3));
    look(pose);
    obstacles.clearUnder({pose.x, pose.y});
    if (i % 50 == 0) obstacles.removeUncertain();
  }
  const int reach = 5;
  const double near = FakeHardware::kRadius_m / 0.15, close = 1.5 * FakeHardware::kRadius_m / 0.15 + 1;
  for (int y = -40; y <= 40; ++y) {
    for (int x = -40; x <= 40; ++x) {
      int walls_near = 0, walls_close = 0;
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          if (map[{x + dx, y + dy}].evidence < 3) continue;
          walls_near += std::hypot(dx, dy) < near;
          walls_close += std::hypot(dx, dy) < close;
        }
      }
      ASSERT_EQ((map[{x, y}].walls_near), walls_near);
      ASSERT_EQ((map[{x, y}].walls_close), walls_close);
    }
  }
}

}  // namespace
}  // namespace robosim
