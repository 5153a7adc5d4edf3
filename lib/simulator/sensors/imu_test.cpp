#include "sensors/imu.h"

#include <cmath>

#include <gtest/gtest.h>

#include "hardware/inertial_reading.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

InertialReading readingOf(SingleRobotScene& robot, const Sensor& sensor) {
  return InertialReading::from(std::get<Values>(robot.sense(sensor)));
}

TEST(Imu, MeasuresGravityOnlyOnARobotAtRest) {
  SingleRobotScene robot({});
  EXPECT_EQ(readingOf(robot, *sensorFrom("<imu/>")), (InertialReading{0, 0, 0, 9.80665}));
}

TEST(Imu, MeasuresTheChangeOfTheSpeed) {
  SingleRobotScene robot({});
  robot.former_motion = {0.02, 0};
  robot.motion = {0.05, 0};  // from 0.2 m/s to 0.5 m/s in 0.1 s
  const InertialReading reading = readingOf(robot, *sensorFrom("<imu/>"));
  EXPECT_NEAR(reading.ahead_mps2, 3, 1e-12);
  EXPECT_NEAR(reading.left_mps2, 0, 1e-12);
}

TEST(Imu, MeasuresTheCentripetalAccelerationInACurve) {
  // 0.5 m/s on a circle of 1 m: a step turns by 0.05 rad; v · ω = 0.25 m/s² to the left, as far as a sine is its angle.
  SingleRobotScene robot({});
  robot.former_motion = robot.motion = {0.05, 0.05};
  const InertialReading reading = readingOf(robot, *sensorFrom("<imu/>"));
  EXPECT_NEAR(reading.turn_radps, 0.5, 1e-12);
  EXPECT_NEAR(reading.left_mps2, 5 * std::sin(0.05), 1e-12);
  EXPECT_NEAR(reading.ahead_mps2, 5 * (1 - std::cos(0.05)), 1e-12);
}

TEST(Imu, HasWhiteNoiseOfTheGivenDensity) {
  // The mean over 0.1 s of a density of 0.02 has the standard deviation 0.02 / √(2 · 0.1) = 0.0447.
  const auto imu = sensorFrom(
      "<imu><noise gyro_noise_deg_per_s_per_sqrt_hz='0' gyro_bias_deg_per_s='0' accel_noise_mps2_per_sqrt_hz='0.02' "
      "accel_bias_mps2='0'/></imu>");
  SingleRobotScene robot({});
  constexpr int kSamples = 4000;
  double squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    const InertialReading reading = readingOf(robot, *imu);
    squares += reading.left_mps2 * reading.left_mps2;
    EXPECT_EQ(reading.turn_radps, 0);
  }
  EXPECT_NEAR(squares / kSamples, 0.002, 4 * 0.002 * std::sqrt(2.0 / kSamples));
}

TEST(Imu, HasABiasThatIsConstantInARunAndDifferentInAnother) {
  const auto imu = sensorFrom(
      "<imu><noise gyro_noise_deg_per_s_per_sqrt_hz='0' gyro_bias_deg_per_s='1' gyro_scale='0' "
      "accel_noise_mps2_per_sqrt_hz='0'/></imu>");
  constexpr int kRuns = 2000;
  double squares = 0;
  for (int run = 0; run < kRuns; ++run) {
    SingleRobotScene robot({});
    robot.seed = static_cast<std::uint64_t>(run);
    const double first = readingOf(robot, *imu).turn_radps;
    EXPECT_EQ(readingOf(robot, *imu).turn_radps, first);
    squares += first * first;
  }
  const double variance = std::pow(M_PI / 180, 2);
  EXPECT_NEAR(squares / kRuns, variance, 4 * variance * std::sqrt(2.0 / kRuns));
}

}  // namespace
}  // namespace robosim
