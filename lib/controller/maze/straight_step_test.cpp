#include "maze/straight_step.h"

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

TEST(StraightStep, TurnsThenDrivesItsLength) {
  FakeHardware hardware;
  Robot robot(hardware);
  StraightStep step;
  EXPECT_TRUE(step.hasEnded(robot)) << "before the first step";
  step.begin(M_PI / 2, 3);
  int steps = 0;
  for (; steps < 200; ++steps) {
    step.drive(robot);
    hardware.advance();
    if (step.hasEnded(robot)) break;
  }
  EXPECT_LT(steps, 200);
  const auto& pose = hardware.odometry().odom_from_robot;
  EXPECT_NEAR(pose.phi, M_PI / 2, 0.2);
  EXPECT_NEAR(std::hypot(pose.x, pose.y), 3, 0.11) << "up to one step at 1 m/s";
}

TEST(StraightStep, EndsInFrontOfAnObstacle) {
  FakeHardware hardware;
  Robot robot(hardware);
  StraightStep step;
  step.begin(0, 100);
  EXPECT_FALSE(step.hasEnded(robot));
  hardware.setSonarRange(0, 0.3 * FakeHardware::kRadius_m + 0.01);
  EXPECT_FALSE(step.hasEnded(robot)) << "an echo a centimetre beyond the gap from the robot's edge";
  hardware.setSonarRange(0, 0.3 * FakeHardware::kRadius_m - 0.01);
  EXPECT_TRUE(step.hasEnded(robot));
}

TEST(StraightStep, EndsAtAStall) {
  FakeHardware hardware;
  Robot robot(hardware);
  StraightStep step;
  step.begin(0, 100);
  hardware.mutableReadings().stalled = true;
  EXPECT_TRUE(step.hasEnded(robot));
}

TEST(StraightStep, BrakesBeforeAnObstacle) {
  FakeHardware hardware;
  Robot robot(hardware);
  StraightStep step;
  step.begin(0, 100);
  step.drive(robot);
  EXPECT_EQ(hardware.lastCommand().speed_mps, 1) << "the robot's maximum";
  hardware.setSonarRange(0, 0.5);
  step.drive(robot);
  EXPECT_NEAR(hardware.lastCommand().speed_mps, std::sqrt(0.01 + 2 * (0.5 - 0.15 * 0.25)) - 0.1, 1e-6);
}

}  // namespace
}  // namespace robosim
