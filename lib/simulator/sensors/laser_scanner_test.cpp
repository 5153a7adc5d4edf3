#include "sensors/laser_scanner.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/swept_pose.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr double kTolerance_m = 1e-6;

// A beam straight ahead along the edge of a near box: the footprint of ±1° is half on the box, 2 m ahead, and half on
// the wall, 3 m ahead.
SingleRobotScene halfHidden(double edge_y_m) {
  return SingleRobotScene({block(2.25, edge_y_m - 1, 0.5, 2), block(3.5, 0, 1, 10)});
}

constexpr const char* kMixing =
    "<laser beams='3' field_of_view_deg='4'><noise std_m='0' divergence_deg='2' mixing_std='0'/></laser>";

TEST(LaserScanner, MixesTheSurfacesInTheFootprintByTheirPower) {
  // The edge is 0.5° to the left of the beam: 3/4 of the footprint are on the box. Powers 0.75/4 and 0.25/9, so the
  // share of the wall is 0.129.
  SingleRobotScene robot = halfHidden(2 * std::tan(0.5 * kRadPerDeg));
  const double far_part = 0.25 / (9 / std::pow(std::cos(1 * kRadPerDeg), 2)) * std::cos(1 * kRadPerDeg);
  const double share = far_part / (far_part + 0.75 / 4);
  const auto laser = sensorFrom(kMixing);
  const auto ranges = robot.ranges(*laser);
  EXPECT_NEAR(ranges[0], 2 / std::cos(2 * kRadPerDeg), kTolerance_m);
  EXPECT_NEAR(ranges[1], 2 + share * (3 / std::cos(1 * kRadPerDeg) - 2), 0.005) << "the border is bisected to 1/64";
  EXPECT_NEAR(ranges[2], 3 / std::cos(2 * kRadPerDeg), kTolerance_m);
  EXPECT_EQ(robot.ranges(*laser), ranges) << "a mixed pixel persists";
}

TEST(LaserScanner, MixesOnlyWhereTheFootprintReachesTheEdge) {
  const auto laser = sensorFrom(kMixing);
  EXPECT_NEAR(halfHidden(2 * std::tan(1.1 * kRadPerDeg)).ranges(*laser)[1], 2, kTolerance_m);
  EXPECT_NEAR(halfHidden(-2.6 * std::tan(1.1 * kRadPerDeg)).ranges(*laser)[1], 3, kTolerance_m);
}

TEST(LaserScanner, ReadsTheStrongerOfSurfacesThatAreTooFarApart) {
  const auto laser = sensorFrom(
      "<laser beams='3' field_of_view_deg='4'><noise std_m='0' divergence_deg='2' mixing_std='0' mixing_m='0.5'/>"
      "</laser>");
  EXPECT_NEAR(halfHidden(2 * std::tan(0.5 * kRadPerDeg)).ranges(*laser)[1], 2, kTolerance_m);
  // 1/4 of the footprint is on the box: powers 0.25/4 and 0.75/9.
  EXPECT_NEAR(halfHidden(-2 * std::tan(0.5 * kRadPerDeg)).ranges(*laser)[1], 3, kTolerance_m);
}

TEST(LaserScanner, MixesTheExpectedShareOfBeamsAtEdges) {
  // Edges at random angles between beams of 1°; a footprint of 0.4° contains the edge for 2 · 0.2° of each degree.
  const auto laser = sensorFrom(
      "<laser beams='3' field_of_view_deg='2'><noise std_m='0' divergence_deg='0.4' mixing_std='0'/></laser>");
  Rng rng(7);
  constexpr int n = 2000;
  int mixed = 0;
  for (int i = 0; i < n; ++i) {
    const auto ranges = halfHidden(2 * std::tan(rng.uniform(-0.5, 0.5) * kRadPerDeg)).ranges(*laser);
    for (const double range_m : ranges) mixed += range_m > 2.01 && range_m < 2.99;
  }
  EXPECT_NEAR(mixed / double{n}, 0.4, 4 * std::sqrt(0.4 * 0.6 / n));
}

TEST(LaserScanner, LosesEchoesByReflectivityAndAngleOfIncidence) {
  constexpr int n = 4000;
  const auto share = [&](double reflectivity, double turned_rad) {
    SingleRobotScene robot({block(2 + 0.5 / std::cos(turned_rad), 0, 1, 40, turned_rad)});
    robot.reflectivity = {static_cast<float>(reflectivity)};
    const auto laser = sensorFrom("<laser beams='1'><noise std_m='0' reach_m='4' fading='0.2'/></laser>");
    int detected = 0;
    for (int i = 0; i < n; ++i) detected += robot.ranges(*laser)[0] < 8;
    return detected / double{n};
  };
  // Power: reflectivity · cos · (4/2)². Detected with probability 1 / (1 + power^(-1/0.2)).
  const auto expected = [](double power) { return 1 / (1 + std::pow(power, -5)); };
  EXPECT_NEAR(share(1, 0), expected(4), 0.003);
  EXPECT_NEAR(share(0.25, 0), 0.5, 0.032);
  EXPECT_NEAR(share(0.3, 0), expected(1.2), 0.032);
  EXPECT_NEAR(share(0.5, M_PI / 3), 0.5, 0.032) << "0.5 · cos 60° · 4 = 1";
  EXPECT_EQ(share(0, 0), 0);
}

TEST(LaserScanner, MeasuresEachBeamFromThePoseAtItsTime) {
  // Turns by 0.1 rad in 0.1 s before a wall, 2 m ahead. The sweep lasts 0.05 s, so that beam 0 was measured 0.05 rad
  // before the last one.
  SingleRobotScene robot({block(2.5, 0, 1, 40)});
  robot.motion.turn_rad = 0.1;
  const auto ranges = robot.ranges(*sensorFrom("<laser beams='3' field_of_view_deg='60' sweep_s='0.05'/>"));
  EXPECT_NEAR(ranges[0], 2 / std::cos(-M_PI / 6 - 0.05), kTolerance_m);
  EXPECT_NEAR(ranges[1], 2 / std::cos(0 - 0.025), kTolerance_m);
  EXPECT_NEAR(ranges[2], 2 / std::cos(M_PI / 6), kTolerance_m);
}

TEST(LaserScanner, MeasuresBeamsOfOddIndexInALaterRevolution) {
  // 2 m/s straight ahead: 0.02 s are 0.04 m. Beams at -60°, 0° and 60°, of which the middle one is odd.
  SingleRobotScene robot({block(2.5, 0, 1, 40)});
  robot.motion.length_m = 0.2;
  const auto ranges = robot.ranges(*sensorFrom("<laser beams='3' field_of_view_deg='120' interlace_s='0.02'/>"));
  EXPECT_NEAR(ranges[0], 2 * 2.04, kTolerance_m);
  EXPECT_NEAR(ranges[1], 2, kTolerance_m);
  EXPECT_NEAR(ranges[2], 2 * 2.04, kTolerance_m);
  // With a sweep of 0.01 s and an age of 0.03 s the beams are 0.06 s, 0.035 s and 0.05 s old.
  const auto all = robot.ranges(
      *sensorFrom("<laser beams='3' field_of_view_deg='120' interlace_s='0.02' sweep_s='0.01' latency_s='0.03'/>"));
  EXPECT_NEAR(all[0], 2 * 2.12, kTolerance_m);
  EXPECT_NEAR(all[1], 2.07, kTolerance_m);
  EXPECT_NEAR(all[2], 2 * 2.1, kTolerance_m);
  robot.motion.length_m = 0;
  EXPECT_NEAR(robot.ranges(*sensorFrom("<laser beams='3' interlace_s='0.02'/>"))[1], 2, kTolerance_m);
}

TEST(LaserScanner, MeasuresFromWhereItWasBeforeItsLatency) {
  SingleRobotScene robot({block(2.5, 0, 1, 40)});
  robot.motion.length_m = 0.2;  // straight ahead in 0.1 s
  EXPECT_NEAR(robot.ranges(*sensorFrom("<laser beams='1' latency_s='0.03'/>"))[0], 2.06, kTolerance_m);
  EXPECT_NEAR(robot.ranges(*sensorFrom("<laser beams='1' latency_s='0.2'/>"))[0], 2.4, kTolerance_m)
      << "the last motion is extrapolated";
}

TEST(LaserScanner, VariesTheAgeOfItsScans) {
  // 2 m/s straight ahead: an age of 0.1 s with a standard deviation of 0.02 s is 0.2 m with 0.04 m.
  SingleRobotScene robot({block(2.5, 0, 1, 40)});
  robot.motion.length_m = 0.2;
  const auto laser = sensorFrom("<laser beams='3' field_of_view_deg='120' latency_s='0.1' latency_std_s='0.02'/>");
  EXPECT_TRUE(laser->isNoisy());
  constexpr int n = 4000;
  double sum_m = 0, sum_m2 = 0;
  for (int i = 0; i < n; ++i) {
    const auto ranges = robot.ranges(*laser);
    EXPECT_NEAR(ranges[0], 2 * ranges[1], kTolerance_m) << "all beams have the same age";
    EXPECT_NEAR(ranges[2], 2 * ranges[1], kTolerance_m);
    const double moved_m = ranges[1] - 2;
    sum_m += moved_m;
    sum_m2 += moved_m * moved_m;
  }
  const double mean_m = sum_m / n;
  EXPECT_NEAR(mean_m, 0.2, 4 * 0.04 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(sum_m2 / n - mean_m * mean_m), 0.04, 4 * 0.04 / std::sqrt(2.0 * n));
  robot.motion.length_m = 0;
  EXPECT_NEAR(robot.ranges(*laser)[1], 2, kTolerance_m) << "at rest the age has no effect";
}

TEST(LaserScanner, MultipliesTheDeviationOfTheAgeOfAShareOfItsScans) {
  // 2 m/s straight ahead: an age of 0.5 s is 1 m. Deviations of 0.01 s are 0.02 m, in one of ten scans 0.2 m.
  const std::vector<Solid> wall{block(2.5, 0, 1, 40)};
  SingleRobotScene robot(wall), same_robot(wall), same_robot_again(wall);
  robot.motion.length_m = same_robot.motion.length_m = same_robot_again.motion.length_m = 0.2;
  const std::string age = "<laser beams='1' latency_s='0.5' latency_std_s='0.01'";
  const auto normal = sensorFrom(age + "/>");
  const auto no_tail = sensorFrom(age + " latency_tail='0' latency_tail_factor='10'/>");
  const auto tail = sensorFrom(age + " latency_tail='0.1' latency_tail_factor='10'/>");
  constexpr int n = 20000;
  int in_tail = 0;
  double sum_m2 = 0;
  for (int i = 0; i < n; ++i) {
    const double normal_m = robot.ranges(*normal)[0] - 3;
    EXPECT_EQ(same_robot.ranges(*no_tail)[0] - 3, normal_m);
    const double deviation_m = same_robot_again.ranges(*tail)[0] - 3;
    sum_m2 += deviation_m * deviation_m;
    if (deviation_m == normal_m) continue;
    EXPECT_NEAR(deviation_m, 10 * normal_m, 10 * kTolerance_m);
    ++in_tail;
  }
  EXPECT_NEAR(in_tail, 0.1 * n, 4 * std::sqrt(0.1 * 0.9 * n));
  // Variance: 0.9 + 0.1 · 10² = 10.9 times that of a usual scan. Fourth moment: 3 (0.9 + 0.1 · 10⁴) = 3003 times.
  EXPECT_NEAR(sum_m2 / n, 10.9 * 0.0004, 4 * 0.0004 * std::sqrt((3003 - 10.9 * 10.9) / n));
}

TEST(LaserScanner, RejectsATailOfAnAgeThatDoesNotVary) {
  const auto errorOf = [](const std::string& settings) -> std::string {
    try {
      sensorFrom("<laser " + settings + "/>");
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(errorOf("latency_s='0.1' latency_tail='0.1'")
                .find(": <laser latency_tail=\"0.1\">: multiplies latency_std_s, which is 0; set latency_std_s"),
            std::string::npos)
      << errorOf("latency_s='0.1' latency_tail='0.1'");
  EXPECT_NE(errorOf("latency_std_s='0.1' latency_tail='1.1'").find("latency_tail"), std::string::npos);
  EXPECT_NE(errorOf("latency_std_s='0.1' latency_tail='1' latency_tail_factor='0.9'").find("latency_tail_factor"),
            std::string::npos);
  EXPECT_EQ(errorOf("latency_std_s='0.1' latency_tail='1' latency_tail_factor='100'"), "");
}

TEST(LaserScanner, ReachesRobotsFartherByTheMotionDuringItsSweepAndWithoutLimitIfItsAgeHasNone) {
  const auto reach = [](const std::string& timing) {
    return sensorFrom("<laser beams='3' range_max_m='8' x_m='0.1' y_m='0' " + timing + "/>")->robotReach(2);
  };
  EXPECT_NEAR(reach(""), 8.1, 1e-9);
  EXPECT_NEAR(reach("sweep_s='0.1' latency_s='0.2'"), 8.7, 1e-9);
  EXPECT_NEAR(reach("sweep_s='0.1' latency_s='0.2' interlace_s='0.05'"), 8.8, 1e-9);
  EXPECT_TRUE(std::isinf(reach("latency_s='0.2' latency_std_s='0.01'")));
}

TEST(LaserScanner, MeasuresNoScanFromTheFuture) {
  SingleRobotScene robot({block(2.5, 0, 1, 40)});
  robot.motion.length_m = 0.2;
  const auto laser = sensorFrom("<laser beams='1' latency_std_s='0.02'/>");
  int now = 0;
  constexpr int n = 1000;
  for (int i = 0; i < n; ++i) {
    const double range_m = robot.ranges(*laser)[0];
    EXPECT_GE(range_m, 2 - kTolerance_m);
    now += range_m < 2 + kTolerance_m;
  }
  EXPECT_NEAR(now, n / 2, 4 * std::sqrt(n / 4.0)) << "half of the normal distribution is below 0";
}

TEST(SweptPose, LiesOnTheArcOfTheLastMotion) {
  // A quarter circle of radius 1 about (0, 1) that ends at (1, 1), heading 90°, with half of it at 45°.
  const PlanarTransform now({1, 1, M_PI_2}, 0.5);
  SweptPose pose(now, {.length_m = M_PI_2, .turn_rad = M_PI_2}, 1, 0.25);
  for (const double angle : {0.0, M_PI / 8, M_PI / 4, 3 * M_PI / 8, M_PI_2}) {
    const auto at = pose.pointToWorld({0, 0, 0});
    EXPECT_NEAR(at.x, std::sin(angle), 1e-12);
    EXPECT_NEAR(at.y, 1 - std::cos(angle), 1e-12);
    EXPECT_NEAR(at.z, 0.5, 1e-12);
    const auto ahead = pose.turnToWorld({1, 0, 0});
    EXPECT_NEAR(std::atan2(ahead.y, ahead.x), angle, 1e-12);
    pose.next();
  }
}

TEST(SweptPose, LiesOnTheArcOfAMotionToTheSide) {
  // To the left with a quarter turn: a circle of radius 1 about (-1, 0), from (0, 0) to (-1, 1).
  SweptPoseAside pose(PlanarTransform({-1, 1, M_PI_2}, 0.5), {.turn_rad = M_PI_2, .lateral_m = M_PI_2}, 1, 0.25);
  for (const double angle : {0.0, M_PI / 8, M_PI / 4, 3 * M_PI / 8, M_PI_2}) {
    const auto at = pose.pointToWorld({0, 0, 0});
    EXPECT_NEAR(at.x, std::cos(angle) - 1, 1e-12);
    EXPECT_NEAR(at.y, std::sin(angle), 1e-12);
    pose.next();
  }
}

TEST(LaserScanner, KeepsItsReadingBetweenScans) {
  // Steps of 0.1 s, 4 scans per second: at the steps 3 (0.25 s), 5, 8, 10; shifted by 0.1 s: 1, 4, 6, 9, 11.
  const auto changes = [](const char* xml) {
    SingleRobotScene robot({block(2.5, 0, 1, 4)});
    const auto laser = sensorFrom(xml);
    std::string steps;
    double last_m = 0;
    for (int step = 1; step <= 11; ++step) {
      const double range_m = robot.ranges(*laser)[0];
      if (range_m != last_m) steps += std::to_string(step) + " ";
      last_m = range_m;
    }
    return steps;
  };
  EXPECT_EQ(changes("<laser beams='1' rate_hz='4'><noise/></laser>"), "3 5 8 10 ");
  EXPECT_EQ(changes("<laser beams='1' rate_hz='4' phase_s='0.1'><noise/></laser>"), "1 4 6 9 11 ");
  EXPECT_EQ(changes("<laser beams='1' rate_hz='100'><noise/></laser>"), "1 2 3 4 5 6 7 8 9 10 11 ");
  EXPECT_TRUE(sensorFrom("<laser rate_hz='4'/>")->sensesInHostProcess());
  EXPECT_EQ(sensorFrom("<laser rate_hz='4' phase_s='0.1'/>")->info().times, (MeasurementTimes{4, 0.1}));
  EXPECT_EQ(sensorFrom("<sonar firing_interval_s='0.04'><at/></sonar>")->info().times, (MeasurementTimes{25, 0}));
  EXPECT_EQ(sensorFrom("<sonar><at/></sonar>")->info().times, MeasurementTimes());
  EXPECT_FALSE(sensorFrom("<laser noise='lms200'/>")->sensesInHostProcess());
}

}  // namespace
}  // namespace robosim
