#include "sensors/gnss.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "hardware/gnss_fix.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr double kEquator_m = 6378137;
/// At 0° N, 0° E, where a metre to the east is 1 / a radians.
const GeoReference kEquator;

GnssFix fixOf(SingleRobotScene& robot, const Sensor& sensor) {
  return GnssFix::from(std::get<Values>(robot.sense(sensor)));
}

TEST(Gnss, MeasuresThePositionOfItsAntenna) {
  const auto gnss = sensorFrom("<gnss x_m='0.5' z_m='0.3' rate_hz='0'/>");
  SingleRobotScene robot({}, {3, 4, M_PI / 2});
  robot.georeference = &kEquator;
  const GnssFix fix = fixOf(robot, *gnss);  // the antenna is at (3, 4.5)
  EXPECT_TRUE(fix.is_valid);
  const GeoPosition expected = kEquator.positionOf({3, 4.5}, 0.3);
  EXPECT_NEAR(fix.latitude_deg, expected.latitude_deg, 1e-12);
  EXPECT_NEAR(fix.longitude_deg, expected.longitude_deg, 1e-12);
  EXPECT_NEAR(fix.altitude_m, expected.altitude_m, 2e-9);
}

TEST(Gnss, HasNoFixInAWorldWithoutAGeoreference) {
  SingleRobotScene robot({}, {3, 4, 0});
  EXPECT_EQ(fixOf(robot, *sensorFrom("<gnss/>")), GnssFix{});
}

TEST(Gnss, KeepsItsFixBetweenTwoMeasurements) {
  const auto gnss = sensorFrom("<gnss/>");  // one per second; a step takes 0.1 s
  SingleRobotScene robot({}, {0, 0, 0});
  robot.georeference = &kEquator;
  const GnssFix first = fixOf(robot, *gnss);
  robot.world_from_robot.x = 100;
  int changes = 0;
  GnssFix last = first;
  for (int step = 0; step < 30; ++step) {
    robot.world_from_robot.x += 1;
    const GnssFix fix = fixOf(robot, *gnss);
    changes += fix == last ? 0 : 1;
    last = fix;
  }
  EXPECT_EQ(changes, 3);
}

/// Errors to the east [m], one per step of 0.1 s.
std::vector<double> errorsOf(const std::string& noise, int steps) {
  const auto gnss = sensorFrom("<gnss rate_hz='0'><noise " + noise + "/></gnss>");
  SingleRobotScene robot({});
  robot.georeference = &kEquator;
  std::vector<double> errors;
  for (int step = 0; step < steps; ++step) errors.push_back(toRadians(fixOf(robot, *gnss).longitude_deg) * kEquator_m);
  return errors;
}

TEST(Gnss, HasSlowErrorsOfTheGivenDeviation) {
  // 4,000 correlation times of 5 steps each; the mean of the squares of n independent normal values has a relative
  // standard deviation of √(2 / n).
  const auto errors = errorsOf("horizontal_std_m='2' correlation_s='0.5' white_std_m='0'", 20'000);
  double squares = 0, products = 0;
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
    squares += errors[i] * errors[i];
    products += errors[i] * errors[i + 1];
  }
  EXPECT_NEAR(squares / static_cast<double>(errors.size()), 4, 4 * 4 * std::sqrt(2.0 / 4000));
  // Within a period the errors of two steps correlate by cos(π / 2 / 5) in the mean of their phases: 0.951; the pair
  // across a knot does, too.
  EXPECT_NEAR(products / squares, std::cos(M_PI / 10), 0.03);
}

TEST(Gnss, LosesTheGivenShareOfItsFixes) {
  const auto gnss = sensorFrom("<gnss rate_hz='0'><noise dropout='0.25'/></gnss>");
  SingleRobotScene robot({});
  robot.georeference = &kEquator;
  int lost = 0;
  for (int step = 0; step < 4000; ++step) lost += fixOf(robot, *gnss).is_valid ? 0 : 1;
  EXPECT_NEAR(lost, 1000, 4 * std::sqrt(4000 * 0.25 * 0.75));
}

}  // namespace
}  // namespace robosim
