#include "run/known_world.h"

#include <gtest/gtest.h>

#include "world/world.h"

namespace robosim {
namespace {

WorldObject boxAt(double x, double y, double length_m, double width_m, double center_z_m = 0.3) {
  WorldObject object;
  object.body = {
      .shape = Cube{length_m, width_m}, .world_from_body = {x, y, 0}, .center_z_m = center_z_m, .height_m = 0.6};
  return object;
}

World emptyWorld() {
  World world;
  world.bounds = {-1, 3, 2, 4};
  return world;
}

Fleet oneRobot() {
  Fleet fleet;
  fleet.robots.emplace_back().info.height_m = 0.5;
  return fleet;
}

std::vector<std::size_t> occupiedOf(const KnownWorld& known) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < known.occupied.size(); ++i) {
    if (known.occupied[i]) cells.push_back(i);
  }
  return cells;
}

TEST(KnownWorld, HasCellsOf5CmFromTheLowerLeftCorner) {
  const auto known = makeKnownWorld(emptyWorld(), oneRobot());
  EXPECT_EQ(known->columns, 80u);
  EXPECT_EQ(known->rows, 40u);
  EXPECT_NEAR(known->center(0).x, -0.975, 1e-12);
  EXPECT_NEAR(known->center(81).y, 2.075, 1e-12);
  EXPECT_TRUE(occupiedOf(*known).empty());
}

TEST(KnownWorld, ContainsObstaclesAtTheHeightOfRobots) {
  World world = emptyWorld();
  world.objects.push_back(boxAt(0, 3, 0.12, 0.12));     // x from -0.06 to 0.06, y from 2.94 to 3.06
  world.objects.push_back(boxAt(1, 3, 0.1, 0.1, 0.9));  // from 0.6 m, above the robot
  const auto known = makeKnownWorld(world, oneRobot());
  // The centres of two cells by two are in it, and those around them are 1.5 cm away, or 2.1 cm at the corners.
  EXPECT_EQ(occupiedOf(*known).size(), 16u);
}

TEST(KnownWorld, ContainsTheHeatSources) {
  World world = emptyWorld();
  world.objects.push_back(boxAt(0, 3, 0.1, 0.1));
  world.objects.push_back(boxAt(1, 3, 0.1, 0.1));
  world.objects.back().body.heat_celsius = 20;
  const auto known = makeKnownWorld(world, oneRobot());
  ASSERT_EQ(known->sources.size(), 1u);
  EXPECT_EQ(known->sources[0].place, mrpt::math::TPoint2D(1, 3));
  EXPECT_EQ(known->sources[0].heat_celsius, 20);
}

TEST(KnownWorld, HasLargerCellsInALargeWorld) {
  World world = emptyWorld();
  world.bounds = {0, 400, 0, 400};  // 160,000 m² in 4,000,000 cells
  EXPECT_NEAR(makeKnownWorld(world, oneRobot())->cell_m, 0.2, 1e-12);
}

}  // namespace
}  // namespace robosim
