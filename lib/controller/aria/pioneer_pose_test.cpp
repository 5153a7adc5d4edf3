#include "aria/pioneer_pose.h"

#include <random>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(PioneerPose, WrapsAnglesToTheHalfOpenTurn) {
  EXPECT_EQ(Math::fixAngle(180), 180);
  EXPECT_EQ(Math::fixAngle(-180), 180);
  EXPECT_EQ(Math::fixAngle(181), -179);
  EXPECT_EQ(Math::fixAngle(-541), 179);
  EXPECT_EQ(Math::fixAngle(720), 0);
  EXPECT_EQ(Math::addAngle(170, 20), -170);
  EXPECT_EQ(Math::subAngle(-170, 20), 170);
}

TEST(PioneerPose, FindsAnglesInACounterClockwiseInterval) {
  EXPECT_TRUE(Math::angleBetween(0, -30, 30));
  EXPECT_TRUE(Math::angleBetween(30, -30, 30));
  EXPECT_FALSE(Math::angleBetween(31, -30, 30));
  EXPECT_FALSE(Math::angleBetween(0, 30, -30));
  EXPECT_TRUE(Math::angleBetween(180, 30, -30));
  EXPECT_TRUE(Math::angleBetween(123, -180, 180));
}

TEST(PioneerPose, ComputesTrigonometryInDegrees) {
  EXPECT_NEAR(Math::sin(30), 0.5, 1e-15);
  EXPECT_NEAR(Math::cos(120), -0.5, 1e-15);
  EXPECT_NEAR(Math::atan2(-1, 0), -90, 1e-13);
  EXPECT_EQ(Math::roundInt(-2.5), -3);
  const auto [x, y] = Math::pointRotate(100, 0, 90);
  EXPECT_NEAR(x, 0, 1e-12);
  EXPECT_NEAR(y, 100, 1e-12);
}

TEST(PioneerPose, FindsDistanceAndDirection) {
  const PioneerPose here{.x = 100, .y = 200, .th = 45}, there{.x = 400, .y = -200, .th = 0};
  EXPECT_DOUBLE_EQ(here.findDistanceTo(there), 500);
  EXPECT_DOUBLE_EQ(here.squaredFindDistanceTo(there), 250000);
  EXPECT_NEAR(here.findAngleTo(there), -53.13010235415598, 1e-12);
}

TEST(PioneerPose, AddsAndSubtractsComponents) {
  const PioneerPose a{.x = 1, .y = 2, .th = 170}, b{.x = 10, .y = 20, .th = 30};
  EXPECT_EQ(a + b, (PioneerPose{.x = 11, .y = 22, .th = -160}));
  EXPECT_EQ(a - b, (PioneerPose{.x = -9, .y = -18, .th = 140}));
}

TEST(PioneerPose, SetsItsHeadingWithinATurn) {
  PioneerPose pose;
  pose.setPose(1, 2, 270);
  EXPECT_EQ(pose, (PioneerPose{.x = 1, .y = 2, .th = -90}));
  pose.setThRad(M_PI / 2);
  EXPECT_DOUBLE_EQ(pose.getTh(), 90);
}

TEST(PioneerTransform, MapsALocalPointToItsPlace) {
  // A robot at (1000, 500), heading along y: 200 mm ahead is y + 200, 100 mm to its left is x - 100.
  const PioneerTransform global_from_local(PioneerPose{.x = 1000, .y = 500, .th = 90});
  const PioneerPose place = global_from_local.doTransform({.x = 200, .y = 100, .th = 100});
  EXPECT_NEAR(place.x, 900, 1e-9);
  EXPECT_NEAR(place.y, 700, 1e-9);
  EXPECT_NEAR(place.th, -170, 1e-9);
}

TEST(PioneerTransform, MapsOnePoseToTheOtherAndBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> mm(-5000, 5000), deg(-179, 180);
  const auto any = [&] { return PioneerPose{.x = mm(random), .y = mm(random), .th = deg(random)}; };
  for (int i = 0; i < 1000; ++i) {
    const PioneerPose from = any(), to = any(), other = any();
    const PioneerTransform transform(from, to);
    const PioneerPose mapped = transform.doTransform(from);
    EXPECT_NEAR(mapped.findDistanceTo(to), 0, 1e-8);
    EXPECT_NEAR(Math::subAngle(mapped.th, to.th), 0, 1e-9);
    const PioneerPose back = transform.doInvTransform(transform.doTransform(other));
    EXPECT_NEAR(back.findDistanceTo(other), 0, 1e-8);
    EXPECT_NEAR(Math::subAngle(back.th, other.th), 0, 1e-9);
    EXPECT_NEAR(transform.doTransform(other).findDistanceTo(to), other.findDistanceTo(from), 1e-8);
  }
}

}  // namespace
}  // namespace robosim
