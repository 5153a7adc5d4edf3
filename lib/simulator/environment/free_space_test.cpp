#include "robots/free_space.h"

#include <gtest/gtest.h>

#include "environment/testing/small_world.h"

namespace robosim {
namespace {

constexpr HeightSpan kHeights{0, 0.3};

TEST(FreeSpace, TouchesTheWholeEdgeOfAnOpenSquare) {
  // A disc of 0.5 m on 10 m × 10 m: its centre may be on 9 m of each side. With cells of 0.25 m there are 36 along a
  // side, whose centres are 0.125 m inside: 4 × 36 × 0.25 m.
  const World world = emptyWorld(5);
  const FreeSpace free(world, 0.5, kHeights);
  EXPECT_NEAR(free.openEdge(free.largestRegion()), 36, 1e-9);
}

TEST(FreeSpace, TouchesNoEdgeOfAClosedSquare) {
  // The walls' outer faces are the edge. Those of 2 mm are as in a map of lines.
  for (const double thickness_m : {0.2, 0.002}) {
    World world = emptyWorld(5);
    for (const double side : {-1, 1}) {
      addWall(world, side * (5 - thickness_m / 2), 0, thickness_m, 10);
      addWall(world, 0, side * (5 - thickness_m / 2), 10, thickness_m);
    }
    const FreeSpace free(world, 0.5, kHeights);
    EXPECT_EQ(free.openEdge(free.largestRegion()), 0) << thickness_m;
  }
}

TEST(FreeSpace, ReachesNoEdgeBehindAWall) {
  // A wall from side to side at x = 2: from the left of it the edge at x = 5 is out of reach.
  World world = emptyWorld(5);
  addWall(world, 2, 0, 0.2, 10);
  const FreeSpace free(world, 0.5, kHeights);
  for (const auto cell : free.reachableFrom({{0, 0}})) EXPECT_LT(free.place(cell).x, 1.4);
  EXPECT_EQ(free.largestRegion(), free.reachableFrom({{0, 0}}));
}

TEST(FreeSpace, IgnoresSolidsAboveTheDisc) {
  World world = emptyWorld(5);
  addWall(world, 2, 0, 0.2, 10);
  world.objects.back().body.center_z_m = 2;
  const FreeSpace free(world, 0.5, kHeights);
  EXPECT_NEAR(free.openEdge(free.reachableFrom({{0, 0}})), 36, 1e-9);
}

TEST(FreeSpace, ExcludesUnknownCells) {
  // A map of 10 × 10 cells of 1 m on the square; its right half is unknown.
  World world = emptyWorld(5);
  WorldMap map;
  map.world_from_map = {-5, -5, 0};
  map.plan.columns = map.plan.rows = 10;
  map.plan.cell_m = 1;
  map.plan.unknown = {{5, 0, 5, 10}};
  world.maps.push_back(map);
  FreeSpace free(world, 0.5, kHeights);
  free.blockUnknown(world);
  for (const auto cell : free.largestRegion()) EXPECT_LT(free.place(cell).x, 0);
}

TEST(FreeSpace, RejectsAWorldOfTooManyCells) { EXPECT_THROW(FreeSpace(emptyWorld(2600), 0.5, kHeights), ConfigError); }

}  // namespace
}  // namespace robosim
