// Errors of sonars: lobe, second echoes, blanking, ringing, firing order, and interference.
#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/registry.h"
#include "sensors/sonar.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr double kSinglePrecision = 1e-5;
constexpr double kNoEcho_m = 5;

/// A sonar at the robot's centre of the axis only, without random errors.
std::unique_ptr<Sensor> thin(const std::string& noise, const std::string& attributes = "") {
  return sensorFrom("<sonar model='rays' rays='1' " + attributes + "><at z_m='0.1'/><noise std_per_m='0' " + noise +
                    "/></sonar>");
}

/// A long wall whose nearest point is at `distance_m`, in the direction `angle_deg`.
Solid wallTowards(double distance_m, double angle_deg) {
  const double angle = toRadians(angle_deg);
  return block((distance_m + 0.5) * std::cos(angle), (distance_m + 0.5) * std::sin(angle), 1, 30, angle);
}

double range(const Solid& solid, const Sensor& sonar) { return SingleRobotScene({solid}).ranges(sonar)[0]; }

TEST(SonarLobe, DetectsANearWallUpToTheAngleOfTheLobe) {
  const auto sonar = thin("wall_deg='42' far_deg='42'");
  EXPECT_NEAR(range(wallTowards(1, 41), *sonar), 1, kSinglePrecision) << "at its nearest point, not along the axis";
  EXPECT_NEAR(range(wallTowards(1, 43), *sonar), kNoEcho_m, kSinglePrecision);
}

TEST(SonarLobe, NarrowsLinearlyWithTheRange) {
  // From 40° at the sonar to 10° at 5 m: 28° at 2 m.
  const auto sonar = thin("wall_deg='40' far_deg='10' lobe_range_m='5'");
  EXPECT_NEAR(range(wallTowards(2, 27), *sonar), 2, kSinglePrecision);
  EXPECT_NEAR(range(wallTowards(2, 29), *sonar), kNoEcho_m, kSinglePrecision);
}

TEST(SonarLobe, DetectsEdgesAndPillarsWithinAShareOfThatAngle) {
  const auto sonar = [](const char* share) {
    return sensorFrom(std::string("<sonar beam_width_deg='80'><at z_m='0.1'/><noise std_per_m='0' wall_deg='40' "
                                  "far_deg='40' edge_share='") +
                      share + "'/></sonar>");
  };
  const Solid aside = pillar(2 * std::cos(M_PI / 9), 2 * std::sin(M_PI / 9), 0.1);  // 20° aside
  EXPECT_NEAR(range(aside, *sonar("0.55")), 1.9, kSinglePrecision) << "up to 22°";
  EXPECT_NEAR(range(aside, *sonar("0.45")), kNoEcho_m, kSinglePrecision) << "up to 18°";
  // A box turned by 45°, with its corner 20° aside.
  const double middle_m = 2 + std::sqrt(0.5);
  const Solid box = block(middle_m * std::cos(M_PI / 9), middle_m * std::sin(M_PI / 9), 1, 1, M_PI / 9 + M_PI_4);
  EXPECT_NEAR(range(box, *sonar("0.55")), 2, kSinglePrecision);
  EXPECT_NEAR(range(box, *sonar("0.45")), kNoEcho_m, kSinglePrecision);
}

TEST(SonarLobe, DetectsWhatLiesAheadBehindABodyTooFarAside) {
  const auto sonar = sensorFrom(
      "<sonar beam_width_deg='80'><at z_m='0.1'/><noise std_per_m='0' wall_deg='40' far_deg='40' edge_share='0.5'/>"
      "</sonar>");
  SingleRobotScene robot({pillar(1, 0.7, 0.1), wallTowards(3, 0)});
  EXPECT_NEAR(robot.ranges(*sonar)[0], 3, kSinglePrecision);
}

TEST(SonarLobe, DoesNotDetectAHiddenNearestPoint) {
  // The wall's nearest point is 30° aside, behind a pillar; the ray along the axis meets the wall at 2 / cos 30°.
  const auto sonar = thin("wall_deg='40' far_deg='40'");
  SingleRobotScene robot({wallTowards(2, 30), pillar(1.5 * std::cos(M_PI / 6), 1.5 * std::sin(M_PI / 6), 0.2)});
  EXPECT_NEAR(robot.ranges(*sonar)[0], kNoEcho_m, kSinglePrecision);
}

TEST(SonarEcho, ReturnsFromTheApexOfARightAngledCorner) {
  // Walls at x = 2 and y = 1 meet at (2, 1), 26.6° aside. The ping along the axis of a sonar that is turned by 20°
  // meets x = 2 first; its nearest point (2, 0) is 20° off the axis, outside a lobe of 15°; the apex is 6.6° off: √5 m.
  const std::vector<Solid> corner{block(2.5, 0, 1, 20), block(0, 1.5, 20, 1)};
  const auto sonar = [](const char* second) {
    return sensorFrom(
        "<sonar model='rays' rays='1'><at z_m='0.1' angle_deg='20'/><noise std_per_m='0' wall_deg='15' "
        "far_deg='15' second_echoes='" +
        std::string(second) + "'/></sonar>");
  };
  SingleRobotScene robot(corner);
  EXPECT_NEAR(robot.ranges(*sonar("0"))[0], kNoEcho_m, kSinglePrecision);
  EXPECT_NEAR(robot.ranges(*sonar("1"))[0], std::sqrt(5), kSinglePrecision);
}

TEST(SonarEcho, ReturnsTheWayItCameFromASurfaceThatFacesTheReflectedPing) {
  // A mirror at 45°, met at (2, 0), reflects the ping to the left, where a wall faces it 1.5 m away.
  const double half = std::sqrt(0.5);
  SingleRobotScene robot({block(2 + 0.1 * half, -0.1 * half, 0.2, 1, -M_PI_4), block(2, 2, 3, 1)});
  EXPECT_NEAR(robot.ranges(*thin("specular_deg='15' second_echoes='1'"))[0], 3.5, kSinglePrecision);
  EXPECT_NEAR(robot.ranges(*thin("specular_deg='15'"))[0], kNoEcho_m, kSinglePrecision);
}

TEST(SonarBlanking, RepeatsEchoesFromTooNearUntilAfterIt) {
  // 0.3 m: the ping returns after 0.3, 0.6, 0.9 m; the blanking ends at 0.7 m.
  EXPECT_NEAR(range(wallTowards(0.3, 0), *thin("blanking_m='0.7'")), 0.9, kSinglePrecision);
  EXPECT_NEAR(range(wallTowards(0.8, 0), *thin("blanking_m='0.7'")), 0.8, kSinglePrecision);
}

TEST(SonarRinging, ReadsTheEndOfTheBlankingAtItsRate) {
  SingleRobotScene robot({wallTowards(2, 0)});
  const auto sonar = thin("blanking_m='0.25' ringing='0.2'");
  int rings = 0;
  for (int i = 0; i < 4000; ++i) {
    const double range_m = robot.ranges(*sonar)[0];
    EXPECT_TRUE(std::abs(range_m - 2) < kSinglePrecision || std::abs(range_m - 0.25) < kSinglePrecision) << range_m;
    rings += range_m < 1 ? 1 : 0;
  }
  EXPECT_NEAR(rings, 800, 4 * std::sqrt(4000 * 0.2 * 0.8));
}

TEST(SonarFiring, OneSonarOfEachArrayAtATimeAndTheOthersKeepTheirReadings) {
  // 40 ms in steps of 0.1 s: two or three pings per step. Two arrays of four, so that step 1 updates sonars 0 and 1 of
  // each (pings at 40 and 80 ms), and step 2 sonars 2, 3 and 0 (120, 160 and 200 ms).
  SingleRobotScene robot({wallTowards(1, 0)});
  const auto sonar = sensorFrom("<sonar model='rays' rays='1' firing_interval_s='0.04' array='4'>" + [] {
    std::string mounts;
    for (int i = 0; i < 8; ++i) mounts += "<at z_m='0.1'/>";
    return mounts;
  }() + "</sonar>");
  const auto which = [&] {
    std::string fired;
    for (const double range_m : robot.ranges(*sonar))
      fired += std::abs(range_m - (1 - robot.world_from_robot.x)) < kSinglePrecision ? '1' : '0';
    return fired;
  };
  EXPECT_EQ(which(), "11001100");
  robot.world_from_robot.x = 0.1;
  EXPECT_EQ(which(), "10111011");
  robot.world_from_robot.x = 0.2;
  EXPECT_EQ(which(), "01100110") << "200 ms to 300 ms: pings at 240 and 280 ms, of sonars 1 and 2";
}

TEST(SonarFiring, UpdatesEachOfEightSonarsEvery320Milliseconds) {
  const SonarFiring pioneer{.interval_s = 0.04, .array = 8};
  for (std::size_t sonar = 0; sonar < 16; ++sonar) {
    int fired = 0;
    for (std::uint64_t step = 1; step <= 320; ++step) fired += pioneer.fires(sonar, {step, 0.1}) ? 1 : 0;
    EXPECT_EQ(fired, 100) << "in 32 s";
  }
  EXPECT_TRUE(pioneer.fires(7, {0, 0.1})) << "at the start";
}

TEST(SonarNoise, SetIsListedAsASettingThatMayBeAbsent) {
  for (const char* kind : {"sonar", "infrared", "laser"}) {
    for (const XmlSetting& setting : settingsOf(*sensorType(kind))) {
      if (setting.name == "noise") {
        EXPECT_EQ(setting.default_text, "none") << kind;
      }
    }
  }
}

TEST(SonarNoise, SetPolaroidIsOverriddenByAttributesOfNoise) {
  const auto error = [](const std::string& xml) -> std::string {
    try {
      sensorFrom(xml);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "none";
  };
  const auto sonar = sensorFrom("<sonar noise='polaroid' range_max_m='4'><at/></sonar>");
  EXPECT_TRUE(sonar->isNoisy());
  EXPECT_NEAR(sonar->info().noise_std_m, 0.04, 1e-12);
  EXPECT_NEAR(
      sensorFrom("<sonar noise='polaroid' range_max_m='4'><at/><noise std_per_m='0.02'/></sonar>")->info().noise_std_m,
      0.08, 1e-12);
  EXPECT_EQ(error("<sonar noise='polaroids'><at/></sonar>"),
            "sensor.xml:1: <sonar noise=\"polaroids\">: is unknown; accepted are: polaroid");
  EXPECT_EQ(error("<sonar noise='sick'><at/><noise/></sonar>"),
            "sensor.xml:1: <sonar>: noise=\"sick\" is unknown; accepted are: polaroid");
  EXPECT_EQ(error("<sonar><at/><noise wall_deg='100'/></sonar>"),
            "sensor.xml:1: <noise wall_deg=\"100\">: must lie in [0, 90] degrees; drop it for the default, 0");
}

}  // namespace
}  // namespace robosim
