#include "sensors/wheel_errors.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

/// <odometry> with these attributes and without random errors.
std::unique_ptr<Sensor> wheels(const std::string& attributes) {
  return sensorFrom("<odometry><noise length_std_per_sqrt_m='0' turn_std_per_sqrt_rad='0' drift_std_per_sqrt_m='0' " +
                    attributes + "/></odometry>");
}

Odometry measured(const Sensor& sensor, const Motion& motion) {
  SingleRobotScene robot({});
  robot.motion = motion;
  return std::get<Odometry>(robot.sense(sensor));
}

TEST(WheelErrors, UnequalWheelsTurnTheOdometryOfAStraightLine) {
  // Both wheels travel 0.1 m. E_d = 1.25: the right one is 2.5 / 2.25 of the mean, its encoder counts 0.1 · 0.9 m; the
  // left one is 2 / 2.25 of it, and counts 0.1 · 1.125 m. Length: 0.10125 m; turn: (0.09 - 0.1125) / 0.5 = -0.045 rad.
  const auto odometry = measured(*wheels("diameter_ratio='1.25' wheelbase_m='0.5'"), {0.1, 0});
  EXPECT_NEAR(odometry.speed_mps, 1.0125, 1e-12);
  EXPECT_NEAR(odometry.turn_radps, -0.45, 1e-12);
}

TEST(WheelErrors, AWiderWheelbaseMakesTurnsAppearLarger) {
  const auto odometry = measured(*wheels("wheelbase_ratio='1.05'"), {0.1, 0.2});
  EXPECT_NEAR(odometry.odom_from_robot.phi, 0.21, 1e-12);
  EXPECT_NEAR(odometry.speed_mps, 1, 1e-12);
}

TEST(WheelErrors, SlipGrowsWithTheTurnRate) {
  // 0.1 rad in 0.1 s are 1 rad/s: a share of 0.05 slips. At 2 rad/s it is 0.1.
  const auto sensor = wheels("turn_slip_s='0.05'");
  EXPECT_NEAR(measured(*sensor, {0, 0.1}).odom_from_robot.phi, 0.105, 1e-12);
  EXPECT_NEAR(measured(*sensor, {0, -0.2}).odom_from_robot.phi, -0.22, 1e-12);
}

TEST(WheelErrors, BlockedWheelsSlip) {
  // 0.3 m of a path of 0.4 m are clipped; a quarter of that is driven by the slipping wheels.
  SingleRobotScene robot({});
  robot.motion = {0.1, 0};
  robot.path = Path{.world_from_start = {}, .length_m = 0.4, .turn_rad = 0, .end_fraction = 0.25};
  const auto odometry = std::get<Odometry>(robot.sense(*wheels("contact_slip='0.25'")));
  EXPECT_NEAR(odometry.odom_from_robot.x, 0.1 + 0.25 * 0.3, 1e-12);
}

TEST(WheelErrors, AreNoneByDefaultWithNoise) {
  ErrorList errors;
  const XmlElement noise{"noise", "", {}, {}, {}};
  XmlReader reader(noise, "", errors);
  const auto read = WheelErrors::read(reader, 0.2);
  EXPECT_TRUE(read.isNone());
  EXPECT_NEAR(read.wheelbase_m, 0.25, 1e-12);
}

TEST(WheelErrors, AreThoseOfTheDrive) {
  const auto faultOf = [](const char* attribute, DriveKind kind) {
    ErrorList errors;
    const XmlElement noise{"noise", "", {{attribute, "1"}}, {}, {}};
    XmlReader reader(noise, "r.xml", errors);
    WheelErrors::read(reader, 0.2, {.kind = kind});
    reader.finish();
    return !errors.empty();
  };
  EXPECT_FALSE(faultOf("lateral_slip", DriveKind::omni));
  EXPECT_TRUE(faultOf("lateral_slip", DriveKind::differential));
  EXPECT_FALSE(faultOf("steering_offset_deg", DriveKind::car));
  EXPECT_TRUE(faultOf("steering_offset_deg", DriveKind::tracked));
  EXPECT_FALSE(faultOf("diameter_ratio", DriveKind::tracked));
  EXPECT_TRUE(faultOf("lateral_slip", DriveKind::car));
}

TEST(WheelErrors, OfACarHaveNoEffectFromRatiosOfItsDiameters) {
  ErrorList errors;
  const XmlElement noise{"noise", "", {{"diameter_ratio", "1.1"}, {"turn_slip_s", "0.5"}}, {}, {}};
  XmlReader reader(noise, "r.xml", errors);
  const WheelErrors read = WheelErrors::read(reader, 0.2, {.kind = DriveKind::car, .wheelbase_m = 0.5});
  EXPECT_TRUE(read.isNone()) << "its turns are measured by the steering";
  EXPECT_TRUE(errors.empty());
}

TEST(WheelErrors, ReportsImpossibleRatios) {
  try {
    wheels("diameter_ratio='3'");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "sensor.xml:1: <noise diameter_ratio=\"3\">: must lie in [0.5, 2]; drop it for the default, 1");
  }
}

}  // namespace
}  // namespace robosim
