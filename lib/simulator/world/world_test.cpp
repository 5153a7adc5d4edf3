#include "world/world.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Body, IsADiscForACylinder) {
  Body body;
  body.shape = Cylinder{0.3};
  body.world_from_body = {1, 2, 0.5};
  body.center_z_m = 0.5;
  body.height_m = 1;
  const Solid solid = body.solid();
  const auto& circle = std::get<Circle>(solid.outline);
  EXPECT_EQ(circle.center, mrpt::math::TPoint2D(1, 2));
  EXPECT_EQ(circle.radius_m, 0.3);
  EXPECT_EQ(solid.heights, (HeightSpan{0, 1}));
  EXPECT_EQ(body.coveringRadius(), 0.3);
}

TEST(UnknownOf, ContainsNeitherWallsNorOccupiedCells) {
  WorldMap map;
  map.plan.columns = map.plan.rows = 2;
  map.plan.cell_m = 1;
  map.plan.occupied = {{0, 0, 1, 1}};
  map.plan.unknown = {{1, 1, 1, 1}};
  map.plan.boxes = {{{5, 5, 0}, 2, 1}};
  const auto unknown = unknownSolids(map);
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_NEAR(std::get<OrientedBox>(unknown[0].outline).center.x, 1.5, 1e-12);
  World world;
  world.maps = {map};
  EXPECT_EQ(startSolids(world).size(), 2u);
}

TEST(Body, IsAnOrientedBoxForACube) {
  Body body;
  body.shape = Cube{4, 3};
  body.world_from_body = {1, 2, M_PI / 2};
  body.height_m = 1;
  const Solid solid = body.solid();
  const Bounds2D bounds = boundsOf(solid.outline);
  EXPECT_NEAR(bounds.x_min, 1 - 1.5, 1e-12);
  EXPECT_NEAR(bounds.x_max, 1 + 1.5, 1e-12);
  EXPECT_NEAR(bounds.y_min, 2 - 2, 1e-12);
  EXPECT_NEAR(bounds.y_max, 2 + 2, 1e-12);
  EXPECT_EQ(solid.heights, (HeightSpan{-0.5, 0.5}));
  EXPECT_DOUBLE_EQ(body.coveringRadius(), 2.5);
}

}  // namespace
}  // namespace robosim
