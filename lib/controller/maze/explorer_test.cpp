#include "maze/explorer.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

constexpr double kWarm = 2;

/// Two rooms, 6 m × 4 m in all, with a door between them at the side opposite to the start.
std::vector<OrientedBox> twoRooms() {
  auto walls = FakeMaze::room(-1, 5, -1, 3);
  walls.push_back(FakeMaze::box(2, 0.35, 0.1, 2.7));  // leaves 1.25 m at the top
  return walls;
}

struct Search {
  Search(std::vector<OrientedBox> walls, mrpt::math::TPoint2D gold, double heat, std::uint64_t seed = 1)
      : maze(std::move(walls), gold, heat), robot(maze.hardware), explorer(robot, {.seed = seed}, kWarm) {}
  /// Steps until the heat exceeds `heat`, at most `most` steps. @return the number of steps
  int stepsTo(double heat, int most) {
    for (int i = 0; i < most; ++i) {
      if (*robot.heat() > heat) return i;
      step();
    }
    return most;
  }
  void step() {
    explorer.step(robot);
    maze.hardware.advance();
    stalls += robot.stalled();
  }
  FakeMaze maze;
  Robot robot;
  Explorer explorer;
  int stalls = 0;
};

TEST(Explorer, FindsGoldBehindAWall) {
  Search search(twoRooms(), {4.4, -0.4}, 20);
  EXPECT_LT(search.stepsTo(15, 2000), 1000);
  EXPECT_LT(search.stalls, 10);
}

TEST(Explorer, SearchesTheWholeMapBeforeItRestarts) {
  Search search(twoRooms(), {99, 99}, 0);
  // Every place of gold, at least 0.3 m from walls, must have come within the range of the heat sensor (3 m − 2.5
  // radii).
  std::vector<mrpt::math::TPoint2D> unsearched;
  for (double x = -0.7; x <= 4.7; x += 0.2) {
    for (double y = -0.7; y <= 2.7; y += 0.2) unsearched.emplace_back(x, y);
  }
  for (int i = 0; i < 4000 && search.explorer.rounds() == 0; ++i) {
    search.step();
    const auto& pose = search.maze.pose();
    std::erase_if(unsearched,
                  [&](const auto& p) { return std::hypot(p.x - pose.x, p.y - pose.y) < 3 - 2.5 * 0.25 + 0.1; });
  }
  EXPECT_EQ(search.explorer.rounds(), 1);
  EXPECT_TRUE(unsearched.empty());
}

TEST(Explorer, ContinuesAfterTheWholeMapWasSearched) {
  Search search(twoRooms(), {99, 99}, 0);
  for (int i = 0; i < 8000 && search.explorer.rounds() < 3; ++i) search.step();
  EXPECT_EQ(search.explorer.rounds(), 3);
}

TEST(Explorer, ExaminesAWarmObjectAndContinuesTheSearch) {
  // An object near the start that is too cool to be gold: the robot approaches it, then searches the rest of the map.
  Search search(twoRooms(), {0.5, 2.2}, 9);
  double hottest = 0, x_max = 0;
  for (int i = 0; i < 4000 && search.explorer.rounds() == 0; ++i) {
    search.step();
    hottest = std::max(hottest, *search.robot.heat());
    x_max = std::max(x_max, search.maze.pose().x);
  }
  EXPECT_GT(hottest, 8);
  EXPECT_GT(x_max, 2.5);
  EXPECT_EQ(search.explorer.rounds(), 1);
}

TEST(Explorer, IsReproducible) {
  Search a(twoRooms(), {4.4, -0.4}, 20), b(twoRooms(), {4.4, -0.4}, 20);
  for (int i = 0; i < 300; ++i) {
    a.step();
    b.step();
    ASSERT_EQ(a.robot.command(), b.robot.command());
  }
}

TEST(Explorer, ReversesAtAnUndetectedObstacle) {
  FakeHardware hardware;
  Robot robot(hardware);
  Explorer explorer(robot, {.seed = 1}, kWarm);
  hardware.blocked = true;
  double slowest = 0;
  for (int i = 0; i < 40; ++i) {
    explorer.step(robot);
    hardware.advance();
    slowest = std::min(slowest, robot.command().speed_mps);
  }
  EXPECT_LT(slowest, -0.05);
}

TEST(Explorer, ReachesTheGoalAfterAnObstacleInItsPathIsRemoved) {
  // A dead end 1 m wide, with an obstacle, and the same without it.
  auto walls = FakeMaze::room(-1, 4, -0.5, 0.5);
  walls.push_back(FakeMaze::box(1.5, 0, 0.4, 0.4));
  Search search(walls, {3.5, 0}, 20);
  for (int i = 0; i < 300; ++i) search.step();
  EXPECT_LT(search.maze.pose().x, 1.2);
  Search freed(FakeMaze::room(-1, 4, -0.5, 0.5), {3.5, 0}, 20);
  EXPECT_LT(freed.stepsTo(12, 600), 600);
}

TEST(Explorer, NamesMissingSensors) {
  FakeHardware hardware;
  auto sensors = std::make_shared<std::vector<SensorInfo>>(*hardware.info().sensors);
  sensors->pop_back();
  hardware.mutableInfo().sensors = sensors;
  const Robot robot(hardware);
  try {
    const Explorer explorer(robot, {}, kWarm);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "robot 'fake' has no heat, which a gold finder needs; add <heat/> to its model");
  }
}

}  // namespace
}  // namespace robosim
