#include "maze/oracle.h"

#include <gtest/gtest.h>

#include "maze/gold_search.h"
#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

/// A map of 10 m × 6 m from (-2, -3), with gold at a place and an optional wall at x = 2.5 m up to y = `wall_to_m`.
std::shared_ptr<KnownWorld> worldWith(const mrpt::math::TPoint2D& gold, double wall_to_m = -3) {
  auto known = std::make_shared<KnownWorld>();
  known->low = {-2, -3};
  known->cell_m = 0.05;
  known->columns = 200;
  known->rows = 120;
  known->occupied.resize(known->columns * known->rows);
  for (std::size_t i = 0; i < known->occupied.size(); ++i) {
    const auto place = known->center(i);
    known->occupied[i] = std::abs(place.x - 2.5) < 0.05 && place.y < wall_to_m ? 1 : 0;
  }
  known->sources = {{gold, 20}};
  return known;
}

/// Seconds until the gold at its place is found in a maze.
double secondsToFind(FakeMaze& maze, const std::shared_ptr<const KnownWorld>& known) {
  Robot robot(maze.hardware);
  GoldSearch search(std::make_unique<Oracle>(
      ControllerSetup{.seed = 1, .world_from_start = mrpt::math::TPose2D(), .known_world = known}, kGoldHeat_celsius));
  while (robot.activity() == Activity::active && robot.time() < 300) {
    search.step(robot);
    maze.hardware.advance();
  }
  EXPECT_EQ(robot.activity(), Activity::found);
  return robot.time();
}

TEST(Oracle, DrivesStraightToTheGold) {
  FakeMaze maze({}, {7, 0}, 20);
  // The heat exceeds 10 within 1.5 m: it accelerates to 1 m/s in 2 s and 1 m, and drives 4.5 m more; it brakes at the
  // end of its path.
  const double time_s = secondsToFind(maze, worldWith({7, 0}));
  EXPECT_GT(time_s, 6.4);
  EXPECT_LT(time_s, 8);
}

TEST(Oracle, DrivesRoundAKnownWall) {
  const auto wall = FakeMaze::box(2.5, -1, 0.1, 4);  // to y = 1
  FakeMaze maze({wall}, {5, -0.5}, 20);
  // Over the end of the wall the path is longer than 1.6 + 1.6 + ... m: it passes y = 1.25 m.
  const double time_s = secondsToFind(maze, worldWith({5, -0.5}, 1));
  EXPECT_LT(time_s, 12);
  EXPECT_FALSE(maze.hardware.readings().stalled);
}

TEST(Oracle, PlansTheWayRoundBeforeItSeesTheWall) {
  FakeHardware hardware;
  Robot robot(hardware);
  Oracle oracle({.world_from_start = mrpt::math::TPose2D(), .known_world = worldWith({5, -0.5}, 1)}, 10);
  oracle.step(robot);
  ASSERT_FALSE(oracle.path().empty());
  double highest_m = 0;
  for (const auto& cell : oracle.path()) highest_m = std::max(highest_m, (cell.y + 0.5) * 0.15);
  EXPECT_GT(highest_m, 1.2) << "a robot's radius above the end of the wall";
}

TEST(Oracle, ChoosesTheNearestOfSeveralSources) {
  auto known = worldWith({7, 0});
  known->sources.push_back({{-1.9, 2}, 20});
  FakeHardware hardware;
  Robot robot(hardware);
  Oracle oracle({.world_from_start = mrpt::math::TPose2D(), .known_world = known}, 10);
  oracle.step(robot);
  ASSERT_FALSE(oracle.path().empty());
  EXPECT_LT(oracle.path().back().x, 0);
}

TEST(Oracle, DrivesRoundARobotOnItsPath) {
  const auto obstacle = FakeMaze::box(2, 0, 0.4, 0.4);  // not on the map
  FakeMaze maze({obstacle}, {7, 0}, 20);
  EXPECT_LT(secondsToFind(maze, worldWith({7, 0})), 20);
}

TEST(Oracle, WithoutAMapStandsStill) {
  FakeHardware hardware;
  Robot robot(hardware);
  Oracle oracle({}, 10);
  oracle.step(robot);
  EXPECT_EQ(hardware.lastCommand(), Command{});
}

}  // namespace
}  // namespace robosim
