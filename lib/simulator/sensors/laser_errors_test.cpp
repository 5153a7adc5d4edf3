#include "sensors/laser_errors.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

/// A wall whose face is 2 m ahead of the robot, wide enough for all beams of a scan of ±45°.
std::vector<Solid> wallAhead(double range_m = 2) { return {block(range_m + 0.5, 0, 1, 4 * range_m)}; }

struct Statistics {
  double mean = 0, std = 0;
  int count = 0;
};

/// Of the ranges below `no_return_m` of a single beam in `n` steps.
Statistics computeStatistics(SingleRobotScene& robot, const Sensor& laser, int n, double no_return_m = 8) {
  double sum = 0, squares = 0;
  Statistics s;
  for (int i = 0; i < n; ++i) {
    const double range_m = robot.ranges(laser)[0];
    if (range_m >= no_return_m) continue;
    ++s.count;
    sum += range_m;
    squares += range_m * range_m;
  }
  s.mean = sum / s.count;
  s.std = std::sqrt(squares / s.count - s.mean * s.mean);
  return s;
}

TEST(LaserErrors, InterpolateTheStandardDeviationOverTheRange) {
  const auto laser = sensorFrom(
      "<laser beams='1' range_max_m='20'><noise><at range_m='1' std_m='0.01'/><at range_m='5' std_m='0.05'/></noise>"
      "</laser>");
  constexpr int n = 4000;
  // Relative standard error of a standard deviation: 1/√(2n) = 1.1 %; four of them.
  for (const auto& [range_m, std_m] : {std::pair(0.5, 0.01), {2.0, 0.02}, {4.0, 0.04}, {9.0, 0.05}}) {
    SingleRobotScene robot(wallAhead(range_m));
    const Statistics s = computeStatistics(robot, *laser, n, 20);
    EXPECT_NEAR(s.std, std_m, 0.045 * std_m) << range_m;
    EXPECT_NEAR(s.mean, range_m, 4 * std_m / std::sqrt(n)) << range_m;
  }
  EXPECT_DOUBLE_EQ(laser->info().noise_std_m, 0.05);
}

TEST(LaserErrors, RoundReadingsToTheQuantum) {
  SingleRobotScene robot(wallAhead(2.003));
  const auto laser = sensorFrom("<laser beams='1'><noise std_m='0.02' quantum_m='0.01'/></laser>");
  std::set<long> multiples;
  for (int i = 0; i < 1000; ++i) {
    const double steps = robot.ranges(*laser)[0] / 0.01;
    ASSERT_NEAR(steps, std::round(steps), 1e-4);
    multiples.insert(std::lround(steps));
  }
  EXPECT_TRUE(multiples.contains(200));
  EXPECT_GE(multiples.size(), 9u) << "of ±3 standard deviations";
  EXPECT_DOUBLE_EQ(laser->info().noise_std_m, std::sqrt(0.02 * 0.02 + 0.01 * 0.01 / 12));
}

TEST(LaserErrors, WidenTheGivenShareOfReadings) {
  SingleRobotScene robot(wallAhead());
  const auto laser = sensorFrom("<laser beams='1'><noise std_m='0.01' tail='0.1' tail_factor='5'/></laser>");
  constexpr int n = 10000;
  int beyond = 0;
  double squares = 0;
  for (int i = 0; i < n; ++i) {
    const double error_m = robot.ranges(*laser)[0] - 2;
    squares += error_m * error_m;
    beyond += std::abs(error_m) > 0.03;
  }
  // Beyond three standard deviations: 0.9 · 0.0027 + 0.1 · P(|g| > 0.6) = 0.0573, standard error 0.0023.
  EXPECT_NEAR(beyond / double{n}, 0.0573, 4 * 0.0023);
  // Variance 1e-4 · (0.9 + 0.1 · 25) = 3.4e-4; its kurtosis is high, so the bound is wide.
  EXPECT_NEAR(std::sqrt(squares / n), std::sqrt(3.4e-4), 0.001);
  EXPECT_NEAR(laser->info().noise_std_m, std::sqrt(3.4e-4), 1e-12);
}

TEST(LaserErrors, LoseAndMisplaceTheGivenSharesOfEchoes) {
  SingleRobotScene robot(wallAhead());
  const auto laser = sensorFrom("<laser beams='1'><noise std_m='0' dropout='0.2' outlier='0.1'/></laser>");
  constexpr int n = 10000;
  int lost = 0, exact = 0, below_4 = 0;
  for (int i = 0; i < n; ++i) {
    const double range_m = robot.ranges(*laser)[0];
    lost += range_m == 8;
    exact += std::abs(range_m - 2) < 1e-6;
    below_4 += range_m < 4 && std::abs(range_m - 2) > 1e-6;
  }
  EXPECT_NEAR(lost, 2000, 4 * 40);
  EXPECT_NEAR(exact, 7000, 4 * 46);
  EXPECT_NEAR(below_4, 500, 4 * 22) << "half of the outliers, which are uniform up to 8 m";
}

TEST(LaserErrors, DecreaseTheDriftExponentially) {
  LaserErrors errors;
  errors.drift_m = 0.02;
  errors.drift_s = 100;
  EXPECT_DOUBLE_EQ(errors.driftAt(0), 0.02);
  EXPECT_NEAR(errors.driftAt(100), 0.02 * std::exp(-1), 1e-9);
  EXPECT_NEAR(errors.driftAt(1000), 0.02 * std::exp(-10), 1e-9);
  EXPECT_EQ(errors.driftAt(1e6), 0);
  SingleRobotScene robot(wallAhead());
  const auto laser = sensorFrom("<laser beams='1'><noise std_m='0' drift_m='0.02' drift_s='0.1'/></laser>");
  EXPECT_NEAR(robot.ranges(*laser)[0], 2 + 0.02 * std::exp(-1), 1e-6) << "at 0.1 s";
  EXPECT_NEAR(robot.ranges(*laser)[0], 2 + 0.02 * std::exp(-2), 1e-6);
}

TEST(LaserErrors, AreIndependentBetweenBeamsAndSteps) {
  SingleRobotScene robot(wallAhead());
  const auto laser =
      sensorFrom("<laser beams='2' field_of_view_deg='1'><noise std_m='0.01' quantum_m='1e-6'/></laser>");
  constexpr int n = 4000;
  double beams = 0, steps = 0, last_m = 0;
  for (int i = 0; i < n; ++i) {
    const auto ranges = robot.ranges(*laser);
    const double true_m = 2 / std::cos(toRadians(0.5));
    beams += (ranges[0] - true_m) * (ranges[1] - true_m) / 1e-4;
    steps += (ranges[0] - true_m) * last_m / 1e-4;
    last_m = ranges[0] - true_m;
  }
  EXPECT_NEAR(beams / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(steps / n, 0, 4 / std::sqrt(n));
}

std::string laserErrorOf(const std::string& xml) {
  try {
    sensorFrom(xml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(LaserErrors, RefuseInvalidSettings) {
  EXPECT_EQ(laserErrorOf("<laser noise='lms300'/>"),
            "sensor.xml:1: <laser noise=\"lms300\">: is not a type of scanner; accepted are: lms200, urg04lx, utm30lx");
  EXPECT_EQ(laserErrorOf("<laser>\n<noise quantum_m='-1'/></laser>"),
            "sensor.xml:2: <noise quantum_m=\"-1\">: must lie in [0, 1] metres; drop it for the default, 0");
  EXPECT_EQ(laserErrorOf("<laser><noise dropout='0.7' outlier='0.7'/></laser>"),
            "sensor.xml:1: <noise>: has dropout and outlier with a sum above 1, which excludes any other reading; "
            "reduce one of them");
  EXPECT_EQ(
      laserErrorOf("<laser><noise>\n<at range_m='2' std_m='0.1'/>\n<at range_m='1' std_m='0.1'/></noise></laser>"),
      "sensor.xml:3: <at range_m=\"1\">: must be above that of the <at> before it; sort them by range");
  EXPECT_EQ(laserErrorOf("<laser><noise std_m='0.1'><at range_m='1' std_m='0.1'/></noise></laser>"),
            "sensor.xml:1: <noise>: has std_m or std_per_m beside <at>, which replaces both; keep one form");
  EXPECT_EQ(laserErrorOf("<laser rate_hz='-1'/>"),
            "sensor.xml:1: <laser rate_hz=\"-1\">: must lie in [0, 1000] hertz; drop it for the default, 0");
}

TEST(LaserErrors, OfATypeAreReplacedOneByOne) {
  SingleRobotScene robot(wallAhead());
  const auto exact = sensorFrom(
      "<laser beams='1' noise='lms200'><noise std_m='0' tail='0' quantum_m='0' dropout='0' outlier='0' reach_m='0' "
      "drift_m='0' divergence_deg='0'/></laser>");
  EXPECT_NEAR(robot.ranges(*exact)[0], 2, 1e-6);
  const auto typed = sensorFrom("<laser beams='1' noise='lms200'><noise quantum_m='0.5' dropout='0'/></laser>");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(std::fmod(robot.ranges(*typed)[0], 0.5), 0);
  for (const char* name : {"lms200", "urg04lx", "utm30lx"}) {
    const auto laser = sensorFrom("<laser noise='" + std::string(name) + "'/>");
    EXPECT_TRUE(laser->isNoisy()) << name;
    EXPECT_GT(laser->info().noise_std_m, 0.004) << name;
  }
}

}  // namespace
}  // namespace robosim
