#include "hardware/robot_velocity.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(RobotVelocity, OfAStraightMoveIsItsLengthByTime) {
  const RobotVelocity forwards = velocityBetween({1, 2, M_PI / 2}, {1, 2.5, M_PI / 2}, 0.1);
  EXPECT_NEAR(forwards.speed_mps, 5, 1e-12);
  EXPECT_NEAR(forwards.turn_radps, 0, 1e-12);
  EXPECT_NEAR(velocityBetween({1, 2.5, M_PI / 2}, {1, 2, M_PI / 2}, 0.1).speed_mps, -5, 1e-12) << "backwards";
}

TEST(RobotVelocity, OfAnArcHasItsLengthNotThatOfTheChord) {
  // A quarter of a circle with a radius of 2 m, to the left, in half a second.
  const RobotVelocity left = velocityBetween({0, 0, 0}, {2, 2, M_PI / 2}, 0.5);
  EXPECT_NEAR(left.speed_mps, 2 * M_PI, 1e-12);
  EXPECT_NEAR(left.turn_radps, M_PI, 1e-12);
}

TEST(RobotVelocity, OfAnOmnidirectionalRobotHasAPartToTheLeft) {
  const RobotVelocity aside = velocityBetween({0, 0, M_PI / 2}, {-0.5, 0.25, M_PI / 2}, 0.5);
  EXPECT_NEAR(aside.speed_mps, 0.5, 1e-12);
  EXPECT_NEAR(aside.lateral_mps, 1, 1e-12);
  // To the left on a quarter of a circle of 2 m about a point behind it, in half a second.
  const RobotVelocity around = velocityBetween({2, 0, 0}, {0, 2, M_PI / 2}, 0.5);
  EXPECT_NEAR(around.lateral_mps, 2 * M_PI, 1e-12);
  EXPECT_NEAR(around.speed_mps, 0, 1e-12);
}

TEST(RobotVelocity, TurnsTheShortWayAcrossTheBackwardHeading) {
  const RobotVelocity turning = velocityBetween({0, 0, M_PI - 0.1}, {0, 0, -M_PI + 0.1}, 1);
  EXPECT_NEAR(turning.turn_radps, 0.2, 1e-12);
  EXPECT_NEAR(turning.speed_mps, 0, 1e-12);
}

}  // namespace
}  // namespace robosim
