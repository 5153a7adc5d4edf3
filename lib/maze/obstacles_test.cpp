#include "maze/obstacles.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "control/fake_hardware.h"

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

TEST_F(ObstaclesTest, StandWhereAnEchoCameFrom) {
  hardware.setSonarRange(0, 1.0);  // from the edge: 1.25 m ahead
  look();
  EXPECT_TRUE(occupied(1.27, 0.05));
  EXPECT_FALSE(occupied(1.05, 0.05));
  EXPECT_FALSE(occupied(1.6, 0.05));
  look({2, 1, M_PI / 2});
  EXPECT_TRUE(occupied(1.95, 2.27));
}

TEST_F(ObstaclesTest, BlockWhereTheRobotWouldTouchThem) {
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

TEST_F(ObstaclesTest, FadeOnceTheirPlaceIsSeenEmpty) {
  hardware.setSonarRange(0, 1.0);
  for (int i = 0; i < 5; ++i) look();
  hardware.hearNothing();
  look();
  EXPECT_TRUE(occupied(1.27, 0.05));  // seen five times, it does not go at once
  for (int i = 0; i < 10; ++i) look();
  EXPECT_FALSE(occupied(1.27, 0.05));
  EXPECT_FALSE(blocked(1.27, 0.05));
}

TEST_F(ObstaclesTest, StayWhileTheyAreSeenNowAndThen) {
  for (int i = 0; i < 30; ++i) {
    hardware.setSonarRange(0, i % 3 == 0 ? 1.0 : 3.0);
    look();
  }
  EXPECT_TRUE(occupied(1.27, 0.05));
}

TEST_F(ObstaclesTest, ThatAreFarAwayAreLeftOut) {
  hardware.setSonarRange(0, 4.5);  // 30 cells
  look();
  EXPECT_EQ(obstacles.changes(), 0u);
}

TEST_F(ObstaclesTest, TakeInOnlySomeBeamsIfTold) {
  hardware.setSonarRange(1, 1.0);
  hardware.setSonarRange(2, 1.0);
  obstacles.look({}, (*hardware.info().sensors)[1], std::get<Echoes>(hardware.readings().measurements[1]), 2);
  EXPECT_EQ(obstacles.changes(), 1u);
}

TEST_F(ObstaclesTest, CannotBeWhereTheRobotIs) {
  hardware.setSonarRange(0, 1.0);
  look();
  obstacles.clearUnder({1.27, 0.05});
  EXPECT_FALSE(occupied(1.27, 0.05));
}

TEST_F(ObstaclesTest, FeltButNotSeenBlockToo) {
  obstacles.bump({0.5, 0.5});
  EXPECT_TRUE(blocked(0.5, 0.5));
}

TEST_F(ObstaclesTest, SeenOnceAreForgottenAndSeenOftenAreNot) {
  hardware.setSonarRange(0, 1.0);
  look();
  look();
  hardware.setSonarRange(8, 1.0);  // straight behind
  look();
  obstacles.bump({0.5, 0.5});
  obstacles.forgetDoubtful();
  EXPECT_TRUE(occupied(1.27, 0.05));
  EXPECT_FALSE(occupied(-1.27, 0.05));
  EXPECT_FALSE(blocked(0.5, 0.5));
}

TEST_F(ObstaclesTest, CountAroundEachCellWhatIsThere) {
  Rng rng(7);
  for (int i = 0; i < 500; ++i) {
    for (std::size_t beam = 0; beam < 16; ++beam) hardware.setSonarRange(beam, rng.uniform(0.1, 6));
    const mrpt::math::TPose2D pose(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-3, 3));
    look(pose);
    obstacles.clearUnder({pose.x, pose.y});
    if (i % 50 == 0) obstacles.forgetDoubtful();
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
