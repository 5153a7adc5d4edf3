#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/bumper.h"
#include "sensors/compass.h"
#include "sensors/heat.h"
#include "sensors/odometry.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

double scalar(const Measurement& measured) { return std::get<Scalar>(measured).value; }

TEST(Heat, FadesLinearlyToNothingAtItsRange) {
  // The three readings of the 2005 report's Table 1 that are not 0, from the gold at (0, 10) with T = 20 and range 15.
  const auto heat = sensorFrom("<sensor><type>heat</type><range>15</range></sensor>");
  SingleRobotScene robot({});
  robot.heat_sources = {{{0, 10}, 20, BodyId(7)}};
  const auto at = [&](double x, double y) {
    robot.world_from_robot = {x, y, 0};
    return scalar(robot.sense(*heat));
  };
  EXPECT_NEAR(at(4.4, 0), 5.39, 0.06);
  EXPECT_NEAR(at(3.5, 4.9), 11.7, 0.06);
  EXPECT_NEAR(at(-1.1, 15.7), 12.2, 0.07);
  EXPECT_DOUBLE_EQ(at(0, 10), 20);
  EXPECT_DOUBLE_EQ(at(15, 10), 0);
  EXPECT_DOUBLE_EQ(at(16, 10), 0);
}

TEST(Heat, SumsAllSourcesExceptItsOwnRobot) {
  SingleRobotScene robot({});
  robot.heat_sources = {{{1, 0}, 10, BodyId(7)}, {{0, -2}, 20, BodyId(8)}, {{0, 0}, 99, BodyId(0)}};
  // The scene has no stationary solid, so the robot itself is body 0.
  EXPECT_DOUBLE_EQ(scalar(robot.sense(*sensorFrom("<heat range_max_m='4'/>"))), 10 * 0.75 + 20 * 0.5);
}

TEST(Heat, UsesTheFilesUnitInTheInverseLaw) {
  SingleRobotScene robot({});
  robot.heat_sources = {{{1, 0}, 20, BodyId(7)}};
  const auto heat =
      sensorFrom("<sensor><type>heat</type><law>inverse</law><range>15</range></sensor>", {0.1, 0.2, 0.3});
  EXPECT_DOUBLE_EQ(scalar(robot.sense(*heat)), 2) << "10 units away";
}

TEST(Compass, MeasuresTheHeadingInTheWorld) {
  SingleRobotScene robot({}, {1, 2, 0.7});
  EXPECT_DOUBLE_EQ(scalar(robot.sense(*sensorFrom("<compass/>"))), 0.7);
}

/// Mean and standard deviation of a sensor's scalar over 4,000 steps, after `transform`.
template <typename Transform>
std::pair<double, double> meanAndSpread(SingleRobotScene& robot, const Sensor& sensor, const Transform& transform) {
  constexpr int kSamples = 4000;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double value = transform(scalar(robot.sense(sensor)));
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kSamples;
  return {mean, std::sqrt(squares / kSamples - mean * mean)};
}

// With 4,000 samples, the mean's standard error is 1/63 of the spread, the spread's 1/89: bounds are four of them.
TEST(Compass, NoiseOfTheDataSheetIsTwoDegreesAboutTheTrueHeading) {
  SingleRobotScene robot({}, {0, 0, 3});
  const double std_rad = toRadians(2);
  const auto error = [](double heading_rad) { return std::remainder(heading_rad - 3, 2 * M_PI); };
  const auto [mean, spread] = meanAndSpread(robot, *sensorFrom("<compass><noise/></compass>"), error);
  EXPECT_NEAR(mean, 0, 4 * std_rad / 63);
  EXPECT_NEAR(spread, std_rad, 4 * std_rad / 89);
}

TEST(Compass, ReadsAHeadingInTheHalfOpenIntervalDespiteNoise) {
  SingleRobotScene robot({}, {0, 0, M_PI});
  const auto compass = sensorFrom("<compass><noise std_deg='30'/></compass>");
  int negative = 0;
  for (int i = 0; i < 1000; ++i) {
    const double heading_rad = scalar(robot.sense(*compass));
    EXPECT_GT(heading_rad, -M_PI);
    EXPECT_LE(heading_rad, M_PI);
    negative += heading_rad < 0;
  }
  EXPECT_NEAR(negative, 500, 80) << "half of the errors are positive and wrap";
}

TEST(Heat, NoiseHasTheGivenSpreadAboutTheExactReading) {
  SingleRobotScene robot({});
  robot.heat_sources = {{{1, 0}, 10, BodyId(7)}};
  const auto heat = sensorFrom("<heat range_max_m='4'><noise std='0.25'/></heat>");
  const auto [mean, spread] = meanAndSpread(robot, *heat, [](double value) { return value; });
  EXPECT_NEAR(mean, 7.5, 4 * 0.25 / 63) << "10 degrees at a quarter of the range";
  EXPECT_NEAR(spread, 0.25, 4 * 0.25 / 89);
}

TEST(Bumper, IsPressedOnlyWhereSomethingTouches) {
  // The robot's disc of 0.2 m touches the wall on its left (segment 3 of 12 faces 90°) up to a gap of 1 mm.
  SingleRobotScene robot({block(0, 0.701, 4, 1)});
  const auto pressed = std::get<Contacts>(robot.sense(*sensorFrom("<bumper/>"))).pressed;
  ASSERT_EQ(pressed.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(pressed[i], i == 3 ? 1 : 0) << i;
}

TEST(Bumper, IsNotPressedAtAGapOfACentimetre) {
  SingleRobotScene robot({block(0, 0.71, 4, 1)});
  EXPECT_EQ(std::get<Contacts>(robot.sense(*sensorFrom("<bumper/>"))).pressed, std::vector<std::uint8_t>(12, 0));
}

TEST(Bumper, IsPressedByTheEdgeOfTheSurfaceAsByAWall) {
  // The disc of 0.2 m is 1 mm from the edges at x = 5 (bearing 0) and y = -5 (bearing -90°), turned by 30°: segments
  // of 30°, so those at robot bearings -30° and -120°, which are 11 and 8 of 12.
  SingleRobotScene robot({}, {4.799, -4.799, M_PI / 6});
  robot.surface = {-5, 5, -5, 5};
  const auto pressed = std::get<Contacts>(robot.sense(*sensorFrom("<bumper/>"))).pressed;
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(pressed[i], i == 11 || i == 8 ? 1 : 0) << i;
}

TEST(Bumper, IsNotPressedByAnEdgeACentimetreAway) {
  SingleRobotScene robot({}, {4.79, 0, 0});
  robot.surface = {-5, 5, -5, 5};
  EXPECT_EQ(std::get<Contacts>(robot.sense(*sensorFrom("<bumper/>"))).pressed, std::vector<std::uint8_t>(12, 0));
}

TEST(Battery, FallsWithUseDownToEmpty) {
  SingleRobotScene robot({});
  const auto battery = sensorFrom("<battery full_v='13' empty_v='11' standing_h='1' driving_h='0.5'/>");
  const auto voltage = [&] { return std::get<Scalar>(robot.sense(*battery)).value; };
  const double standing_v = 2 * 0.1 / 3600;  // of 2 V, in a step of 0.1 s
  const double at_first = voltage();
  EXPECT_NEAR(at_first - voltage(), standing_v, 1e-12);
  robot.motion = {0.1, 0};
  EXPECT_NEAR(at_first - voltage(), 3 * standing_v, 1e-12) << "driving takes twice as much";
  robot.motion = {0, 0.1};
  EXPECT_NEAR(at_first - voltage(), 5 * standing_v, 1e-12) << "so does turning";
  for (int i = 0; i < 36000; ++i) voltage();
  EXPECT_EQ(voltage(), 11);
}

TEST(Battery, MustBeEmptyBelowFull) { EXPECT_THROW(sensorFrom("<battery full_v='11' empty_v='12'/>"), ConfigError); }

TEST(Odometry, IntegratesArcsExactly) {
  // A quarter circle of radius 1 m in nine steps of 10° ends at (1, 1), heading 90°.
  SingleRobotScene robot({});
  const auto odometry = sensorFrom("<odometry/>");
  robot.motion = {M_PI_2 / 9, M_PI_2 / 9};
  Odometry measured;
  for (int i = 0; i < 9; ++i) measured = std::get<Odometry>(robot.sense(*odometry));
  EXPECT_NEAR(measured.odom_from_robot.x, 1, 1e-12);
  EXPECT_NEAR(measured.odom_from_robot.y, 1, 1e-12);
  EXPECT_NEAR(measured.odom_from_robot.phi, M_PI_2, 1e-12);
  EXPECT_NEAR(measured.speed_mps, M_PI_2 / 9 / 0.1, 1e-12);
}

TEST(Odometry, MeasuresSpeedsWithTheNoiseOfItsPose) {
  SingleRobotScene robot({});
  const auto odometry = sensorFrom("<odometry><noise turn_std_per_sqrt_rad='0' drift_std_per_sqrt_m='0'/></odometry>");
  robot.motion = {0.1, 0};
  const auto first = std::get<Odometry>(robot.sense(*odometry));
  const auto second = std::get<Odometry>(robot.sense(*odometry));
  EXPECT_NE(second.speed_mps, 1) << "0.1 m in 0.1 s, without the noise";
  EXPECT_NEAR(second.speed_mps, (second.odom_from_robot.x - first.odom_from_robot.x) / 0.1, 1e-12);
}

TEST(Odometry, DriftDoesNotDependOnTheLengthOfAStep) {
  // 4 m straight: the error of the distance is 0.02 · √4 = 0.04 m, in 4 steps or in 400.
  const auto spread = [](int steps) {
    double squares = 0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
      SingleRobotScene robot({});
      robot.seed = static_cast<std::uint64_t>(i + 1);
      robot.motion = {4.0 / steps, 0};
      const auto odometry = sensorFrom("<odometry><noise drift_std_per_sqrt_m='0'/></odometry>");
      Odometry measured;
      for (int s = 0; s < steps; ++s) measured = std::get<Odometry>(robot.sense(*odometry));
      squares += std::pow(measured.odom_from_robot.x - 4, 2);
    }
    return std::sqrt(squares / n);
  };
  EXPECT_NEAR(spread(4), 0.04, 0.004);
  EXPECT_NEAR(spread(100), 0.04, 0.004);
}

}  // namespace
}  // namespace robosim
