#include "hardware/command.h"

#include <gtest/gtest.h>

#include "hardware/readings.h"

namespace robosim {
namespace {

TEST(Command, DefaultsToStandingStill) {
  const Command command;
  EXPECT_EQ(command.speed_mps, 0);
  EXPECT_EQ(command.turn_radps, 0);
  EXPECT_EQ(command.laser_pan_rad, 0);
  EXPECT_EQ(command.activity, Activity::active);
}

TEST(Command, ComparesAllMembers) {
  const Command command{.speed_mps = 1, .turn_radps = 2, .laser_pan_rad = 0.5f};
  EXPECT_EQ(command, command);
  Command other = command;
  other.activity = Activity::found;
  EXPECT_NE(command, other);
}

TEST(Readings, OfDifferentKindsAreNeverEqual) {
  const Measurement heat = Scalar{0};
  const Measurement odometry = Odometry{};
  EXPECT_NE(heat, odometry);
  EXPECT_EQ(odometry, Measurement(Odometry{}));
}

TEST(Odometry, StartsAtItsOrigin) {
  const Odometry start;
  EXPECT_EQ(start.odom_from_robot.x, 0);
  EXPECT_EQ(start.odom_from_robot.phi, 0);
  EXPECT_EQ(start.speed_mps, 0);
}

}  // namespace
}  // namespace robosim
