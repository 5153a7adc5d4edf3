#include "sensors/beacons.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

std::vector<float> rangesOf(SingleRobotScene& robot, const Sensor& sensor) {
  return std::get<BeaconRanges>(robot.sense(sensor)).range_m;
}

TEST(Beacons, MeasureTheDistanceFromTheAntennaToEachBeacon) {
  // The robot at (1, 2) faces left (+y): an antenna 1 m ahead of its centre, 0.5 m high, is at (1, 3, 0.5).
  SingleRobotScene robot({}, {1, 2, M_PI / 2});
  const auto sensor = sensorFrom(
      "<beacons x_m='1' z_m='0.5'>"
      "<beacon x_m='4' y_m='7' z_m='0.5'/>"    // 3, 4, 0 away: 5 m
      "<beacon x_m='3' y_m='6' z_m='6.5'/>"    // 2, 3, 6 away: 7 m
      "<beacon x_m='1' y_m='3' z_m='0.5'/>"    // at the antenna
      "<beacon x_m='101' y_m='3' z_m='0.5'/>"  // 100 m away: beyond the range of 50 m
      "</beacons>");
  const auto ranges = rangesOf(robot, *sensor);
  ASSERT_EQ(ranges.size(), 4u);
  EXPECT_NEAR(ranges[0], 5, 1e-6);
  EXPECT_NEAR(ranges[1], 7, 1e-6);
  EXPECT_NEAR(ranges[2], 0, 1e-6);
  EXPECT_EQ(ranges[3], 50.f);
  EXPECT_EQ(sensor->info().no_echo_m, 50);
}

TEST(Beacons, AreFartherAwayBehindAWallByTheBias) {
  // A wall of 1 m height between x = 1.9 and 2.1. The antenna at height 0.5 has line of sight to the beacon at height 2
  // at x = 4 only above the wall: at x = 1.9 the line is at height 0.5 + 1.5 · 1.9 / 4 = 1.21 > 1.
  SingleRobotScene robot({block(2, 0, 0.2, 4)});
  const auto sensor = sensorFrom(
      "<beacons z_m='0.5'><noise std_m='0' wall_bias_m='0.25'/>"
      "<beacon x_m='4' z_m='0.5'/><beacon x_m='4' z_m='2'/><beacon x_m='-4' z_m='0.5'/>"
      "<beacon x_m='1.9' z_m='0.5'/></beacons>");
  const auto ranges = rangesOf(robot, *sensor);
  EXPECT_NEAR(ranges[0], 4.25, 1e-6);
  EXPECT_NEAR(ranges[1], std::sqrt(16 + 2.25), 1e-6);
  EXPECT_NEAR(ranges[2], 4, 1e-6);
  EXPECT_NEAR(ranges[3], 1.9, 1e-6) << "mounted on the near side of the wall";
}

TEST(Beacons, NoiseIsGaussianWithTheGivenDeviationAndIndependentForEachBeacon) {
  SingleRobotScene robot({});
  const auto sensor = sensorFrom("<beacons><noise/><beacon x_m='3'/><beacon y_m='6'/></beacons>");
  EXPECT_TRUE(sensor->isNoisy());
  EXPECT_EQ(sensor->info().noise_std_m, 0.1);
  constexpr int kSamples = 4000;
  double sum = 0, squares = 0, products = 0;
  for (int i = 0; i < kSamples; ++i) {
    const auto ranges = rangesOf(robot, *sensor);
    const double error_m = ranges[0] - 3, other_m = ranges[1] - 6;
    sum += error_m;
    squares += error_m * error_m;
    products += error_m * other_m;
  }
  // The standard errors of mean and deviation are 1/63 and 1/89 of the deviation; that of the covariance is 1/63 of the
  // variance. Bounds are four of them.
  EXPECT_NEAR(sum / kSamples, 0, 4 * 0.1 / 63);
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.1, 4 * 0.1 / 89);
  EXPECT_NEAR(products / kSamples, 0, 4 * 0.01 / 63);
}

TEST(Beacons, NoisyRangesStayBetweenZeroAndTheMaximum) {
  SingleRobotScene robot({});
  const auto sensor =
      sensorFrom("<beacons range_max_m='5'><noise std_m='1' std_per_m='1'/><beacon x_m='3'/></beacons>");
  for (int i = 0; i < 100; ++i) {
    const float range_m = rangesOf(robot, *sensor)[0];
    EXPECT_GE(range_m, 0);
    EXPECT_LE(range_m, 5);
  }
}

TEST(Beacons, AreNotReceivedInAStepWithDropout) {
  SingleRobotScene robot({});
  const auto sensor = sensorFrom("<beacons><noise dropout='0.25'/><beacon x_m='3'/></beacons>");
  int received = 0;
  for (int i = 0; i < 4000; ++i) received += rangesOf(robot, *sensor)[0] < 50 ? 1 : 0;
  EXPECT_NEAR(received, 3000, 4 * std::sqrt(4000 * 0.25 * 0.75));
}

std::string errorFor(const std::string& xml) {
  try {
    sensorFrom(xml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

TEST(Beacons, RejectInvalidOptions) {
  EXPECT_NE(errorFor("<beacons/>").find("<beacons>: has no beacon; add <beacon x_m=\"…\" y_m=\"…\" z_m=\"…\"/>"),
            std::string::npos)
      << errorFor("<beacons/>");
  EXPECT_NE(errorFor("<beacons><beacon id='1'/></beacons>").find("id"), std::string::npos);
  EXPECT_NE(errorFor("<beacons range_max_m='0'><beacon/></beacons>").find("range_max_m"), std::string::npos);
  EXPECT_NE(errorFor("<beacons><noise std_m='-1'/><beacon/></beacons>").find("std_m"), std::string::npos);
}

}  // namespace
}  // namespace robosim
