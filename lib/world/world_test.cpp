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
