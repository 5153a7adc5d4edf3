// Errors of compass, heat sensor, bumper, battery and infrared beams.
#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/infrared_curve.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

double valueOf(SingleRobotScene& robot, const Sensor& sensor) { return std::get<Scalar>(robot.sense(sensor)).value; }

TEST(CompassDeviation, IsASinusoidOncePerTurnOfHardIronAndTwicePerTurnOfSoftIron) {
  const auto error_deg = [](const char* noise, double heading_deg) {
    SingleRobotScene robot({}, {0, 0, toRadians(heading_deg)});
    const auto compass = sensorFrom(std::string("<compass><noise std_deg='0' ") + noise + "/></compass>");
    return std::remainder(toDegrees(valueOf(robot, *compass)) - heading_deg, 360);
  };
  const char* hard = "hard_iron_deg='10' hard_iron_at_deg='30'";
  EXPECT_NEAR(error_deg(hard, 30), 0, 1e-9);
  EXPECT_NEAR(error_deg(hard, 120), 10, 1e-9);
  EXPECT_NEAR(error_deg(hard, -60), -10, 1e-9);
  const char* soft = "soft_iron_deg='4' soft_iron_at_deg='15'";
  EXPECT_NEAR(error_deg(soft, 60), 4, 1e-9);
  EXPECT_NEAR(error_deg(soft, 150), -4, 1e-9);
  EXPECT_NEAR(error_deg(soft, -120), 4, 1e-9);
  EXPECT_NEAR(error_deg("offset_deg='-3' hard_iron_deg='10'", 90), 7, 1e-9);
}

TEST(GyroDrift, GrowsInProportionToTheTime) {
  // 3600° per hour are 0.1° per step of 0.1 s.
  const auto gyro = sensorFrom("<compass><noise std_deg='0' gyro_drift_deg_per_h='-3600'/></compass>");
  EXPECT_FALSE(gyro->isNoisy()) << "not random";
  SingleRobotScene robot({}, {0, 0, M_PI / 2});
  const double first_rad = valueOf(robot, *gyro);
  EXPECT_NEAR(first_rad, M_PI / 2, toRadians(0.11));
  double last_rad = first_rad;
  for (int step = 0; step < 600; ++step) last_rad = valueOf(robot, *gyro);
  EXPECT_NEAR(last_rad, first_rad - M_PI / 3, 1e-9);
  for (int step = 0; step < 1800; ++step) last_rad = valueOf(robot, *gyro);
  EXPECT_NEAR(std::remainder(last_rad - (first_rad - 4 * M_PI / 3), 2 * M_PI), 0, 1e-9) << "wraps";
}

TEST(HeatLag, ApproachesTheHeatByTheSameShareOfTheRestInEachStep) {
  // Steps of 0.1 s and a lag of 0.3 s: a quarter of the rest.
  const auto heat = sensorFrom("<heat range_max_m='4'><noise std='0' lag_s='0.3'/></heat>");
  SingleRobotScene robot({});
  EXPECT_DOUBLE_EQ(valueOf(robot, *heat), 0);
  robot.heat_sources = {{{0, 0}, 16, BodyId(7)}};
  EXPECT_DOUBLE_EQ(valueOf(robot, *heat), 4);
  EXPECT_DOUBLE_EQ(valueOf(robot, *heat), 7);
  EXPECT_DOUBLE_EQ(valueOf(robot, *heat), 9.25);
}

TEST(HeatLag, LeavesTheSpreadOfTheNoise) {
  const auto heat = sensorFrom("<heat range_max_m='4'><noise std='0.5' lag_s='0.3'/></heat>");
  SingleRobotScene robot({});
  double squares = 0;
  constexpr int n = 20000;
  for (int i = 0; i < 100; ++i) valueOf(robot, *heat);
  for (int i = 0; i < n; ++i) squares += std::pow(valueOf(robot, *heat), 2);
  // Successive readings correlate by 3/4: about n · (1 - 9/16) / (1 + 9/16) = 5,600 independent squares.
  EXPECT_NEAR(std::sqrt(squares / n), 0.5, 4 * 0.5 / std::sqrt(2 * 5600.0));
}

TEST(BumperChatter, OpensTouchedSegmentsAtItsRateAndNoOthers) {
  SingleRobotScene robot({block(0, 0.701, 4, 1)});
  const auto bumper = sensorFrom("<bumper><noise chatter='0.2'/></bumper>");
  EXPECT_TRUE(bumper->isNoisy());
  int open = 0;
  for (int step = 0; step < 4000; ++step) {
    const auto pressed = std::get<Contacts>(robot.sense(*bumper)).pressed;
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_TRUE(i == 3 || pressed[i] == 0) << i;
    }
    open += pressed[3] == 0 ? 1 : 0;
  }
  EXPECT_NEAR(open, 800, 4 * std::sqrt(4000 * 0.2 * 0.8));
}

TEST(BumperChatter, MayStillReadAContactInTheFirstStepAfterIt) {
  SingleRobotScene robot({block(0, 0.701, 4, 1)});
  const auto bumper = sensorFrom("<bumper><noise chatter='1'/></bumper>");
  const auto pressed = [&] { return std::get<Contacts>(robot.sense(*bumper)).pressed[3]; };
  robot.world_from_robot.y = -0.1;
  EXPECT_EQ(pressed(), 0) << "never touched";
  const auto honest = sensorFrom("<bumper/>");
  robot.world_from_robot.y = 0;
  EXPECT_EQ(std::get<Contacts>(robot.sense(*honest)).pressed[3], 1);
  robot.world_from_robot.y = -0.1;
  EXPECT_EQ(pressed(), 1) << "bounces after its release";
}

TEST(BatteryLoad, DropsWithTheSpeedsAndRecoversAtRest) {
  const auto battery = sensorFrom(
      "<battery full_v='13' empty_v='11' standing_h='1' driving_h='0.5'>"
      "<noise drop_v_per_mps='0.4' drop_v_per_radps='0.1' speed_mps='0.5'/></battery>");
  SingleRobotScene robot({});
  const double standing_v = 2 * 0.1 / 3600;  // of 2 V, in a step of 0.1 s
  EXPECT_NEAR(valueOf(robot, *battery), 13 - standing_v, 1e-12);
  robot.motion = {-0.05, 0.02};  // 0.5 m/s and 0.2 rad/s
  robot.driven_m = 0.05;         // takes as much more as a step of standing
  EXPECT_NEAR(valueOf(robot, *battery), 13 - 3 * standing_v - 0.2 - 0.02, 1e-12);
  robot.motion = {};
  EXPECT_NEAR(valueOf(robot, *battery), 13 - 4 * standing_v, 1e-12);
}

TEST(InfraredCurve, HasTheVoltagesOfTheDataSheet) {
  const InfraredCurve curve;
  EXPECT_NEAR(curve.voltageAt(0.8), 0.4, 1e-12);
  EXPECT_NEAR(curve.voltageAt(0.1), 2.4, 1e-12);
  EXPECT_NEAR(curve.distanceAt(0.4), 0.8, 1e-12);
}

TEST(InfraredCurve, ReadsStepsOfTheConverter) {
  // At 0.5 m: 0.336 / 0.54 = 0.6222 V, of steps of 0.1 V the sixth: 0.336 / 0.6 - 0.04 m.
  SingleRobotScene robot({block(1, 0, 1, 1)});
  const auto infrared = sensorFrom("<infrared><at z_m='0.1'/><noise std_per_m='0' voltage_step_v='0.1'/></infrared>");
  EXPECT_NEAR(robot.ranges(*infrared)[0], 0.52, 1e-6);
}

TEST(InfraredCurve, ErrorsGrowWithTheSquareOfTheDistance) {
  // 10 mV at 0.6 m: 0.01 · 0.64² / 0.336 = 12.19 mm; at 0.2 m: 0.01 · 0.24² / 0.336 = 1.714 mm.
  const auto infrared = sensorFrom("<infrared><at z_m='0.1'/><noise std_per_m='0' voltage_std_v='0.01'/></infrared>");
  for (const auto& [at_m, std_m] : {std::pair{0.6, 0.01219}, {0.2, 0.001714}}) {
    SingleRobotScene robot({block(at_m + 0.5, 0, 1, 1)});
    double squares = 0;
    constexpr int n = 4000;
    for (int i = 0; i < n; ++i) squares += std::pow(robot.ranges(*infrared)[0] - at_m, 2);
    EXPECT_NEAR(std::sqrt(squares / n), std_m, 0.06 * std_m);
  }
}

TEST(InfraredCurve, ReadsObjectsNearerThanItsFoldAsFarOnes) {
  // The peak is at 6 cm, 0.336 / 0.1 = 3.36 V; at 2 cm there is a third of it, as at 0.336 / 1.12 - 0.04 = 0.26 m.
  SingleRobotScene robot({block(0.52, 0, 1, 1)});
  const auto infrared = sensorFrom("<infrared><at z_m='0.1'/><noise std_per_m='0' fold_m='0.06'/></infrared>");
  EXPECT_NEAR(robot.ranges(*infrared)[0], 0.26, 1e-6);
  EXPECT_NEAR(SingleRobotScene({}).ranges(*infrared)[0], 0.8, 1e-6) << "nothing in range";
}

}  // namespace
}  // namespace robosim
