#include "robots/differential_drive.h"

#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// Per step of 0.1 s: 0.1 m/s faster, 0.4 m/s slower, 0.5 rad/s more or less.
constexpr MotionLimits kDriveLimits{
    .speed_max_mps = 2, .turn_max_radps = 3, .accel_mps2 = 1, .decel_mps2 = 4, .turn_accel_radps2 = 5};

double speedAfterAStep(double now_mps, double target_mps) {
  return reachableSpeeds({now_mps, 0}, {.speed_mps = target_mps}, kDriveLimits, 0.1).speed_mps;
}
double turnAfterAStep(double now_radps, double target_radps) {
  return reachableSpeeds({0, now_radps}, {.turn_radps = target_radps}, kDriveLimits, 0.1).turn_radps;
}

TEST(DifferentialDrive, AcceleratesAndBrakesForwardsAndInReverseByTheSameLimits) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_NEAR(speedAfterAStep(0, sign * 1), sign * 0.1, 1e-12);
    EXPECT_NEAR(speedAfterAStep(sign * 1, sign * 2), sign * 1.1, 1e-12);
    EXPECT_NEAR(speedAfterAStep(sign * 1, 0), sign * 0.6, 1e-12);
    EXPECT_NEAR(speedAfterAStep(sign * 1, sign * 0.9), sign * 0.9, 1e-12) << "no further than the target";
    EXPECT_NEAR(turnAfterAStep(sign * 1, sign * 3), sign * 1.5, 1e-12);
    EXPECT_NEAR(turnAfterAStep(sign * 1, 0), sign * 0.5, 1e-12);
  }
}

TEST(DifferentialDrive, ComesToRestBeforeItReverses) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_NEAR(speedAfterAStep(sign * 0.5, sign * -1), sign * 0.1, 1e-12);
    EXPECT_EQ(speedAfterAStep(sign * 0.1, sign * -1), 0);
    EXPECT_NEAR(speedAfterAStep(0, sign * -1), sign * -0.1, 1e-12);
    EXPECT_EQ(turnAfterAStep(sign * 0.2, sign * -3), 0);
  }
}

TEST(DifferentialDrive, ClampsTargetsToTheLimits) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(speedAfterAStep(sign * 1.95, sign * 9), sign * 2);
    EXPECT_EQ(turnAfterAStep(sign * 2.9, sign * 9), sign * 3);
  }
}

TEST(DifferentialDrive, BrakesForATargetThatIsNotFiniteAndWhenHalted) {
  EXPECT_NEAR(speedAfterAStep(1, std::numeric_limits<double>::quiet_NaN()), 0.6, 1e-12);
  EXPECT_NEAR(speedAfterAStep(1, std::numeric_limits<double>::infinity()), 0.6, 1e-12);
  const Command halted{.speed_mps = 2, .turn_radps = 3, .activity = Activity::halted};
  const DriveSpeeds speeds = reachableSpeeds({1, 1}, halted, kDriveLimits, 0.1);
  EXPECT_NEAR(speeds.speed_mps, 0.6, 1e-12);
  EXPECT_NEAR(speeds.turn_radps, 0.5, 1e-12);
}

TEST(DifferentialDrive, BrakesByTheEmergencyDecelerationInAnEmergencyStop) {
  MotionLimits limits = kDriveLimits;
  limits.emergency_decel_mps2 = 6;  // 1.5 times the usual one
  const Command stop{.speed_mps = 2, .turn_radps = 3, .emergency_stop = true};
  const DriveSpeeds speeds = reachableSpeeds({1.5, -1}, stop, limits, 0.1);
  EXPECT_NEAR(speeds.speed_mps, 0.9, 1e-12);
  EXPECT_NEAR(speeds.turn_radps, -0.25, 1e-12) << "brakes harder in the same proportion";
  for (const double weaker_mps2 : {0.0, 3.0}) {
    limits.emergency_decel_mps2 = weaker_mps2;
    EXPECT_NEAR(reachableSpeeds({1.5, 0}, stop, limits, 0.1).speed_mps, 1.1, 1e-12) << "as always";
  }
}

}  // namespace
}  // namespace robosim
