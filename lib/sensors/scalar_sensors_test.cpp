#include <cmath>

#include <gtest/gtest.h>

#include "sensors/bumper.h"
#include "sensors/compass.h"
#include "sensors/heat.h"
#include "sensors/odometry.h"
#include "sensors/one_robot.h"

namespace robosim {
namespace {

double scalar(const Measurement& measured) { return std::get<Scalar>(measured).value; }

TEST(Heat, FadesLinearlyToNothingAtItsRange) {
  // The three readings of the 2005 report's Table 1 that are not 0, from the gold at (0, 10) with T = 20 and range 15.
  const auto heat = sensorFrom("<sensor><type>heat</type><range>15</range></sensor>");
  OneRobot robot({});
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

TEST(Heat, AddsUpAllSourcesButItsOwnRobot) {
  OneRobot robot({});
  robot.heat_sources = {{{1, 0}, 10, BodyId(7)}, {{0, -2}, 20, BodyId(8)}, {{0, 0}, 99, BodyId(0)}};
  // The scene has no stationary solid, so the robot itself is body 0.
  EXPECT_DOUBLE_EQ(scalar(robot.sense(*sensorFrom("<heat range_max_m='4'/>"))), 10 * 0.75 + 20 * 0.5);
}

TEST(Heat, OfTheInverseLawIsTemperatureOverDistanceInTheFilesUnit) {
  OneRobot robot({});
  robot.heat_sources = {{{1, 0}, 20, BodyId(7)}};
  const auto heat =
      sensorFrom("<sensor><type>heat</type><law>inverse</law><range>15</range></sensor>", {0.1, 0.2, 0.3});
  EXPECT_DOUBLE_EQ(scalar(robot.sense(*heat)), 2) << "10 units away";
}

TEST(Compass, TellsTheHeadingInTheWorld) {
  OneRobot robot({}, {1, 2, 0.7});
  EXPECT_DOUBLE_EQ(scalar(robot.sense(*sensorFrom("<compass/>"))), 0.7);
}

TEST(Bumper, IsPressedOnlyWhereSomethingTouches) {
  // The robot's disc of 0.2 m touches the wall on its left (segment 3 of 12 looks along 90°) up to a gap of 1 mm.
  OneRobot robot({block(0, 0.701, 4, 1)});
  const auto pressed = std::get<Contacts>(robot.sense(*sensorFrom("<bumper/>"))).pressed;
  ASSERT_EQ(pressed.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(pressed[i], i == 3 ? 1 : 0) << i;
}

TEST(Bumper, FeelsNothingWithAGapOfACentimetre) {
  OneRobot robot({block(0, 0.71, 4, 1)});
  EXPECT_EQ(std::get<Contacts>(robot.sense(*sensorFrom("<bumper/>"))).pressed, std::vector<std::uint8_t>(12, 0));
}

TEST(Battery, FallsWithUseDownToEmpty) {
  OneRobot robot({});
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

TEST(Odometry, AddsUpArcsExactly) {
  // A quarter circle of radius 1 m in nine steps of 10° ends at (1, 1), heading 90°.
  OneRobot robot({});
  const auto odometry = sensorFrom("<odometry/>");
  robot.motion = {M_PI_2 / 9, M_PI_2 / 9};
  Odometry told;
  for (int i = 0; i < 9; ++i) told = std::get<Odometry>(robot.sense(*odometry));
  EXPECT_NEAR(told.odom_from_robot.x, 1, 1e-12);
  EXPECT_NEAR(told.odom_from_robot.y, 1, 1e-12);
  EXPECT_NEAR(told.odom_from_robot.phi, M_PI_2, 1e-12);
  EXPECT_NEAR(told.speed_mps, M_PI_2 / 9 / 0.1, 1e-12);
}

TEST(Odometry, DriftDoesNotDependOnTheLengthOfAStep) {
  // 4 m straight: the error of the way is 0.02 · √4 = 0.04 m, in 4 steps or in 400.
  const auto spread = [](int steps) {
    double squares = 0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
      OneRobot robot({});
      robot.seed = static_cast<std::uint64_t>(i + 1);
      robot.motion = {4.0 / steps, 0};
      const auto odometry = sensorFrom("<odometry><noise drift_std_per_sqrt_m='0'/></odometry>");
      Odometry told;
      for (int s = 0; s < steps; ++s) told = std::get<Odometry>(robot.sense(*odometry));
      squares += std::pow(told.odom_from_robot.x - 4, 2);
    }
    return std::sqrt(squares / n);
  };
  EXPECT_NEAR(spread(4), 0.04, 0.004);
  EXPECT_NEAR(spread(100), 0.04, 0.004);
}

}  // namespace
}  // namespace robosim
