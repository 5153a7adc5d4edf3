// Actions that react to contacts and to obstacles ahead.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "aria/actions/action_bumpers.h"
#include "aria/actions/action_decelerating_limiter.h"
#include "aria/actions/action_group.h"
#include "aria/pioneer_robot.h"
#include "aria/stock_actions.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

struct BumpedRobot : testing::Test {
  static constexpr double kTurn = std::numbers::pi / 6;
  FakeHardware hardware;
  /// Segments ahead, 30° to the left, behind.
  std::size_t slot = hardware.addSensor(SensorKind::bumper, {0, kTurn, std::numbers::pi}, Contacts{{0, 0, 0}});
  Robot robot{hardware};
  PioneerRobot pioneer{robot};
  ActionBumpers bumpers;

  void press(const std::vector<std::uint8_t>& pressed) {
    hardware.mutableReadings().measurements[slot] = Contacts{pressed};
  }
  void steps(int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      pioneer.update();
    }
  }
};

TEST_F(BumpedRobot, BacksOffAndTurnsAwayFromAContactInFront) {
  pioneer.addAction(bumpers, 50);
  steps(3);
  EXPECT_EQ(pioneer.getVel(), 0);
  press({0, 1, 0});
  steps(1);
  press({0, 0, 0});
  steps(15);
  EXPECT_NEAR(pioneer.getVel(), -100, 1e-6);
  EXPECT_NEAR(pioneer.getTh(), 0, 1e-6);
  steps(29);  // 3 s of backing off, then the turn
  EXPECT_NEAR(pioneer.getVel(), 0, 1e-6);
  steps(15);
  EXPECT_NEAR(pioneer.getTh(), -60, 1e-3);  // to the right
  EXPECT_GT(bumpers.fire(pioneer, {}).getVelStrength(), 0);
  hardware.mutableReadings().time.step += 10;
  EXPECT_EQ(bumpers.fire(pioneer, {}).getVelStrength(), 0);
}

TEST_F(BumpedRobot, DrivesAheadAfterAContactBehind) {
  press({0, 0, 1});
  EXPECT_EQ(bumpers.fire(pioneer, {}).getVel(), 100);
  press({1, 0, 0});
  EXPECT_EQ(bumpers.fire(pioneer, {}).getVel(), 0);  // blocked ahead as well
  hardware.mutableReadings().time.step += 30;
  ActionDesired turn = bumpers.fire(pioneer, {});
  turn.accountForRobotHeading(pioneer.getTh());
  EXPECT_NEAR(turn.getDeltaHeading(), 90, 1e-9);
}

TEST_F(BumpedRobot, LimitsTheSpeedOnRequest) {
  ActionBumpers limiting("bumpers", 150, 1000, 1000, true);
  EXPECT_EQ(limiting.fire(pioneer, {}).getMaxVelStrength(), 0);
  press({1, 0, 0});
  EXPECT_EQ(limiting.fire(pioneer, {}).getMaxVel(), 150);
  EXPECT_EQ(limiting.fire(pioneer, {}).getMaxNegVel(), -150);
}

TEST_F(BumpedRobot, WandersAwayFromAContact) {
  ActionGroupWander wander(pioneer);
  steps(10);
  EXPECT_GT(pioneer.getVel(), 300);
  press({1, 0, 0});
  steps(1);
  press({0, 0, 0});
  steps(20);
  EXPECT_NEAR(pioneer.getVel(), -100, 1e-6);
  steps(60);
  EXPECT_NEAR(pioneer.getTh(), 90, 1e-3);
  EXPECT_GT(pioneer.getVel(), 300);
}

struct LimitedRobot : testing::Test {
  FakeHardware hardware;
  Robot robot{hardware};
  PioneerRobot pioneer{robot};
  ActionDeceleratingLimiter forwards, backwards{"backwards", false};

  void driveAt(double mm_ps) { hardware.mutableOdometry().speed_mps = mm_ps / 1000; }
};

TEST_F(LimitedRobot, AllowsTheSpeedFromWhichItStopsBeforeThePadding) {
  EXPECT_GT(forwards.fire(pioneer, {}).getMaxVel(), 1000);
  hardware.setSonarRange(0, 1.0);  // a metre before the robot's edge
  // 1000 mm - 100 mm clearance - 50 mm padding = 850 mm at 600 mm/s².
  EXPECT_NEAR(forwards.fire(pioneer, {}).getMaxVel(), std::sqrt(2 * 600 * 850.0), 1e-3);
  driveAt(600);  // halfway between 200 and 1000: 175 mm padding
  EXPECT_NEAR(forwards.fire(pioneer, {}).getMaxVel(), std::sqrt(2 * 600 * 725.0), 1e-3);
  EXPECT_FALSE(forwards.fire(pioneer, {}).getTransDecel());
  EXPECT_GT(-backwards.fire(pioneer, {}).getMaxNegVel(), 1000);
}

TEST_F(LimitedRobot, CreepsWithinThePaddingAndStopsWithinTheClearance) {
  hardware.setSonarRange(0, 0.14);  // 40 mm beyond the clearance, within the padding
  EXPECT_NEAR(forwards.fire(pioneer, {}).getMaxVel(), 200, 1e-9);
  hardware.setSonarRange(0, 0.12);
  EXPECT_NEAR(forwards.fire(pioneer, {}).getMaxVel(), std::sqrt(2 * 600 * 20.0), 1e-2);
  hardware.setSonarRange(0, 0.1);
  EXPECT_NEAR(forwards.fire(pioneer, {}).getMaxVel(), 0, 0.5);
  hardware.setSonarRange(0, 0.05);
  EXPECT_EQ(forwards.fire(pioneer, {}).getMaxVel(), 0);
}

TEST_F(LimitedRobot, BrakesHarderWhenItIsTooFast) {
  driveAt(1000);  // 300 mm padding
  hardware.setSonarRange(0, 0.6);
  // 500 mm to the clearance: 1000² / (2 · 500) = 1000 mm/s².
  EXPECT_NEAR(*forwards.fire(pioneer, {}).getTransDecel(), 1000, 0.1);
  forwards.setParameters({.max_emergency_decel = 800});
  EXPECT_NEAR(*forwards.fire(pioneer, {}).getTransDecel(), 800, 1e-9);
  hardware.setSonarRange(0, 0.05);
  EXPECT_NEAR(*forwards.fire(pioneer, {}).getTransDecel(), 800, 1e-9);
  forwards.setParameters({.use_estop = true, .max_emergency_decel = 800});
  EXPECT_GT(*forwards.fire(pioneer, {}).getTransDecel(), 1e6);
}

TEST_F(LimitedRobot, WidensItsLaneWithTheSpeed) {
  hardware.setSonarRange(1, 1.0);                           // 22.5° to the left: 1155 mm ahead, 478 mm to the side
  EXPECT_GT(forwards.fire(pioneer, {}).getMaxVel(), 1000);  // the lane is 300 mm to either side
  driveAt(1000);                                            // 650 mm
  EXPECT_LT(forwards.fire(pioneer, {}).getMaxVel(), 1000);
}

TEST_F(LimitedRobot, LimitsBackwardMotionByWhatIsBehind) {
  hardware.setSonarRange(8, 1.0);
  EXPECT_NEAR(backwards.fire(pioneer, {}).getMaxNegVel(), -std::sqrt(2 * 600 * 850.0), 1e-3);
  EXPECT_GT(forwards.fire(pioneer, {}).getMaxVel(), 1000);
  driveAt(-1200);
  EXPECT_TRUE(backwards.fire(pioneer, {}).getTransDecel());
}

TEST_F(LimitedRobot, NeverEntersTheClearance) {
  // A wall at 2 m from the start, and a program that wants to drive at full speed.
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const double wall_m = std::uniform_real_distribution<double>(1, 3)(random);
    FakeHardware driven;
    Robot r(driven);
    PioneerRobot p(r);
    ActionDeceleratingLimiter limiter;
    ActionConstantVelocity fast("fast", 1000);
    p.addAction(limiter, 100);
    p.addAction(fast, 50);
    for (int i = 0; i < 150; ++i) {
      driven.advance();
      const double ahead_m = wall_m - driven.odometry().odom_from_robot.x - FakeHardware::kRadius_m;
      ASSERT_GT(ahead_m, 0.08) << wall_m;
      driven.setSonarRange(0, ahead_m);
      p.update();
    }
    EXPECT_LT(wall_m - driven.odometry().odom_from_robot.x - FakeHardware::kRadius_m, 0.15) << wall_m;
  }
}

}  // namespace
}  // namespace robosim
