#include "sensors/sonar.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr double kFloat = 1e-6;  // readings are single precision

std::unique_ptr<Sensor> sonarAhead(const std::string& attributes = "", const std::string& inside = "") {
  return sensorFrom("<sonar " + attributes + "><at x_m='0.2' z_m='0.1'/>" + inside + "</sonar>");
}

TEST(Sonar, MeasuresTheWallAheadFromItsMountingPose) {
  // The wall's face is at x = 2; the sonar is mounted at x = 0.2.
  SingleRobotScene robot({block(2.5, 0, 1, 10)});
  EXPECT_NEAR(robot.ranges(*sonarAhead())[0], 1.8, kFloat);
}

TEST(Sonar, ReportsTheEchosOriginInTheRobotsFrame) {
  SingleRobotScene robot({block(2.5, 0, 1, 10)}, {0.5, 0, 0});
  const auto echo = std::get<Echoes>(robot.sense(*sonarAhead()))[0];
  EXPECT_NEAR(echo.point_m.x, 1.5, kFloat);
  EXPECT_NEAR(echo.point_m.y, 0, kFloat);
  EXPECT_NEAR(echo.point_m.z, 0.1, kFloat);
}

TEST(Sonar, ReportsThePointInTheFrameOfARotatedRobot) {
  // It faces the world's y; the pillar's nearest point is slightly left of the axis.
  SingleRobotScene robot({pillar(-0.1, 3, 0.5)}, {0, 0, M_PI_2});
  const auto echo = std::get<Echoes>(robot.sense(*sonarAhead()))[0];
  const double far = std::hypot(0.1, 2.8);
  EXPECT_NEAR(echo.range_m, far - 0.5, kFloat);
  EXPECT_NEAR(echo.point_m.x, 0.2 + 2.8 * (far - 0.5) / far, kFloat);
  EXPECT_NEAR(echo.point_m.y, 0.1 * (far - 0.5) / far, kFloat);
}

TEST(Sonar, SectorModelDetectsAPillarOffTheAxis) {
  // The pillar's nearest point lies 8° off the axis: inside a sector of ±10°, far from the axis.
  const double off = toRadians(8);
  const std::vector<Solid> solids{pillar(0.2 + 3 * std::cos(off), 3 * std::sin(off), 0.1)};
  EXPECT_NEAR(SingleRobotScene(solids).ranges(*sonarAhead())[0], 2.9, kFloat);
  EXPECT_NEAR(SingleRobotScene(solids).ranges(*sonarAhead("model='rays' rays='1'"))[0], 5, kFloat);
}

TEST(Sonar, RaysModelDetectsOnlyObjectsWithinTheConesHeights) {
  // A shelf is 2 m before the sonar at z = 0.1. At its face the cone of ±10° has risen by 2·tan 10° = 0.353 m: it
  // passes under a shelf that begins at z = 0.5 and hits its underside only 0.4 / sin 10° = 2.3035 m away.
  const auto files_from = [](double z_m) { return Solid{OrientedBox::from({2.7, 0, 0}, 1, 4), {z_m, 1.0}}; };
  const auto range = [](const Solid& shelf, const std::string& range_max_m) {
    return SingleRobotScene({shelf}).ranges(
        *sonarAhead("model='rays' rays='400' range_max_m='" + range_max_m + "'"))[0];
  };
  EXPECT_NEAR(range(files_from(0.5), "2.3"), 2.3, kFloat) << "no echo";
  EXPECT_NEAR(range(files_from(0.5), "5"), 2.31, 0.01) << "the edge of the cone hits the underside";
  // A shelf from z = 0.3 is hit by every ray that rises by 0.2 m or more: the shortest is √(2² + 0.2²) = 2.010 m long.
  EXPECT_NEAR(range(files_from(0.3), "5"), 2.012, 0.0021);
}

TEST(Sonar, SectorModelIgnoresLowerObjects) {
  EXPECT_NEAR(SingleRobotScene({block(2.5, 0, 1, 10, 0, 0.05)}).ranges(*sonarAhead())[0], 5, kFloat);
  EXPECT_NEAR(SingleRobotScene({block(2.5, 0, 1, 10, 0, 0.1)}).ranges(*sonarAhead())[0], 1.8, kFloat);
}

TEST(Sonar, DetectsOnlyObjectsNearerThanItsRange) {
  const std::vector<Solid> wall_at_2{block(2.5, 0, 1, 10)};
  EXPECT_NEAR(SingleRobotScene(wall_at_2).ranges(*sonarAhead("range_max_m='1.8' no_echo_m='9'"))[0], 9, kFloat);
  EXPECT_NEAR(SingleRobotScene(wall_at_2).ranges(*sonarAhead("range_max_m='1.81' no_echo_m='9'"))[0], 1.8, kFloat);
}

TEST(Sonar, NeverReadsLessThanItsMinimum) {
  SingleRobotScene robot({block(0.75, 0, 1, 10)});
  EXPECT_NEAR(robot.ranges(*sonarAhead("range_min_m='0.1'"))[0], 0.1, kFloat);
}

TEST(Sonar, NeverDetectsItsOwnRobot) {
  SingleRobotScene robot({});
  EXPECT_NEAR(robot.ranges(*sensorFrom("<sonar><at x_m='0.1'/></sonar>"))[0], 5, kFloat);
}

TEST(Sonar, RingFacesOutwardsCounterClockwise) {
  // Four sonars on a ring of 0.2 m; walls at distances 1, 2, 3 and 4 ahead, left, behind and right.
  SingleRobotScene robot({block(1.5, 0, 1, 1), block(0, 2.5, 1, 1), block(-3.5, 0, 1, 1), block(0, -4.5, 1, 1)});
  const auto ranges = robot.ranges(*sensorFrom("<sonar><ring count='4' radius_m='0.2'/></sonar>"));
  ASSERT_EQ(ranges.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(ranges[static_cast<std::size_t>(i)], i + 0.8, kFloat) << i;
}

TEST(Sonar, Format2005MountsARingOfTheRobotsRadiusAndReadsTheRangePlusOneUnitWithoutEcho) {
  // unit 0.1 m, radius 3 units: the numbers of opho2_1.md. A wall on the right, its face 10 units from the centre.
  SingleRobotScene robot({block(0, -1.5, 100, 1)});
  const auto sonar =
      sensorFrom("<sensor><id>2</id><type>sonar</type><mode>2</mode><range>15</range></sensor>", Mount{0.1, 0.3, 0.3});
  const auto ranges = robot.ranges(*sonar);
  ASSERT_EQ(ranges.size(), 16u);
  EXPECT_NEAR(ranges[0], 0.7, kFloat) << "sonar 1 faces straight right from the ring: 10 - 3 units";
  EXPECT_NEAR(ranges[15], 0.7, kFloat) << "so does sonar 16";
  EXPECT_NEAR(ranges[3], 1.6, kFloat) << "sonar 4 faces ahead: no echo";
  EXPECT_NEAR(sonar->info().beams[0].robot_from_beam.x, 0.05, 1e-12) << "half a unit ahead of the centre";
  EXPECT_NEAR(sonar->info().beams[15].robot_from_beam.x, -0.05, 1e-12);
  EXPECT_NEAR(sonar->info().beams[3].robot_from_beam.x, 0.29544, 1e-5);
  EXPECT_NEAR(sonar->info().beams[3].robot_from_beam.y, -0.05209, 1e-5);
}

TEST(Sonar, Format2005IsMountedByThePositionInTheFilesUnit) {
  // The robot's middle is at 0.15 m; one unit of 0.1 m higher is 0.25 m.
  const auto sonar =
      sensorFrom("<sensor><type>sonar</type><position><range>15</range><z-relative>1</z-relative></position></sensor>",
                 Mount{0.1, 0.3, 0.3});
  EXPECT_NEAR(sonar->info().beams[3].robot_from_beam.z, 0.25, 1e-12);
  EXPECT_NEAR(sonar->info().range_max_m, 1.5, 1e-12);
}

TEST(Sonar, Format2005Mode1HasTheFrontArrayOnly) {
  const auto sonar = sensorFrom("<sensor><type>sonar</type><mode>1</mode><range>15</range></sensor>");
  EXPECT_EQ(sonar->info().beams.size(), 8u);
}

TEST(Sonar, NoiseIsOffByDefaultAndOnePercentWhenSwitchedOn) {
  SingleRobotScene robot({block(2.7, 0, 1, 10)});  // 2 m ahead
  const auto exact = sonarAhead();
  const auto noisy = sonarAhead("", "<noise/>");
  double sum = 0;
  double squares = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    EXPECT_NEAR(robot.ranges(*exact)[0], 2.0, kFloat);
    const double error = robot.ranges(*noisy)[0] - 2.0;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / n, 0, 4 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.02, 0.001);
}

TEST(Sonar, DropsTheGivenShareOfItsEchoes) {
  SingleRobotScene robot({block(2.7, 0, 1, 10)});
  const auto sonar = sonarAhead("", "<noise std_per_m='0' dropout='0.25'/>");
  int silent = 0;
  for (int i = 0; i < 4000; ++i) silent += robot.ranges(*sonar)[0] > 4 ? 1 : 0;
  EXPECT_NEAR(silent, 1000, 4 * std::sqrt(4000 * 0.25 * 0.75));
}

TEST(Sonar, SpecularWallReturnsNoEchoBeyondItsAngle) {
  // The wall is at 45° to the axis: its nearest point in the sector lies on the edge, 35° from its normal.
  SingleRobotScene robot({block(2.2 + std::sqrt(0.5), 0 - std::sqrt(0.5), 2, 20, M_PI_4)});
  EXPECT_LT(robot.ranges(*sonarAhead("", "<noise std_per_m='0' specular_deg='36'/>"))[0], 5);
  EXPECT_NEAR(robot.ranges(*sonarAhead("", "<noise std_per_m='0' specular_deg='34'/>"))[0], 5, kFloat);
}

TEST(Sonar, NoisyBeamOfAPioneerDetectsAWallUpTo42DegreesFromItsAxis) {
  for (const auto& [axis_from_normal_deg, is_detected] : {std::pair{41.5, true}, {42.5, false}}) {
    const double turned_rad = toRadians(axis_from_normal_deg);
    // The wall meets the axis 1 m ahead of the sonar.
    SingleRobotScene robot({block(1.2 + std::cos(turned_rad), std::sin(turned_rad), 2, 20, turned_rad)});
    const double range_m = robot.ranges(*sonarAhead("beam_width_deg='26'", "<noise std_per_m='0'/>"))[0];
    EXPECT_EQ(range_m < 1, is_detected) << axis_from_normal_deg;
  }
}

TEST(Sonar, ReflectsByTheHorizontalAngleOnly) {
  // 2 m ahead of the sonar, at z = 0.1, is a shelf from z = 0.3 on. The rays that hit it rise by 5.7° or more.
  SingleRobotScene robot({Solid{OrientedBox::from({2.7, 0, 0}, 1, 4), {0.3, 1.0}}});
  EXPECT_LT(robot.ranges(*sonarAhead("model='rays' rays='400'", "<noise std_per_m='0' specular_deg='5'/>"))[0], 2.1);
}

TEST(Sonar, CrosstalkTakesANeighboursNearerEcho) {
  SingleRobotScene robot({block(1.5, 0, 1, 0.2)});
  const auto ring = [](const std::string& crosstalk) {
    return sensorFrom("<sonar><ring count='4' radius_m='0.2'/><noise std_per_m='0' crosstalk='" + crosstalk +
                      "'/></sonar>");
  };
  int mixed = 0;
  const auto sonar = ring("0.5");
  for (int i = 0; i < 2000; ++i) {
    const auto ranges = robot.ranges(*sonar);
    EXPECT_NEAR(ranges[0], 0.8, kFloat);
    EXPECT_NEAR(ranges[2], 5, kFloat) << "its neighbours have no echo";
    mixed += ranges[1] < 4 ? 1 : 0;
  }
  // Crosstalk occurs half the time, in half of these with the neighbour that has an echo.
  EXPECT_NEAR(mixed, 500, 4 * std::sqrt(2000 * 0.25 * 0.75));
}

TEST(Sonar, CrosstalkComesFromSonarsThatAreAdjacentByMountingAngle) {
  // An arc of three sonars, listed as 90°, 0°, -90°, and a wall on the left. The one on the right is next to the first
  // of the list only by its place there.
  SingleRobotScene robot({block(0, 1.5, 0.2, 1)});
  const auto sonar = sensorFrom(
      "<sonar><at z_m='0.1' angle_deg='90'/><at z_m='0.1'/><at z_m='0.1' angle_deg='-90'/>"
      "<noise std_per_m='0' crosstalk='1'/></sonar>");
  int mixed = 0;
  for (int i = 0; i < 200; ++i) {
    const auto ranges = robot.ranges(*sonar);
    EXPECT_NEAR(ranges[0], 1, kFloat);
    EXPECT_NEAR(ranges[2], 5, kFloat) << "faces away from the sonar with an echo";
    mixed += ranges[1] < 4 ? 1 : 0;
  }
  EXPECT_NEAR(mixed, 100, 4 * std::sqrt(200 * 0.25)) << "one of its two neighbours has an echo";
}

TEST(Sonar, CrosstalkComesFromSonarsThatFireInTheSameStep) {
  // 25 ms in steps of 0.1 s: in an array of 16, four sonars fire per step, so 0 to 3 in step 1. Sonar 4, 22.5° from
  // sonar 3, has an echo but does not fire.
  SingleRobotScene robot({block(0, 1.5, 0.2, 0.1)});
  const auto sonar = sensorFrom(
      "<sonar model='rays' rays='1' firing_interval_s='0.025' array='16'><ring count='16' radius_m='0.2' z_m='0.1'/>"
      "<noise std_per_m='0' crosstalk='1'/></sonar>");
  for (int turn = 0; turn < 30; ++turn) {
    const auto ranges = robot.ranges(*sonar);
    EXPECT_NEAR(ranges[3], 5, kFloat) << "turn " << turn;
    for (int step = 1; step < 4; ++step) robot.ranges(*sonar);
  }
}

TEST(Sonar, ReportsFaultsOfItsElement) {
  const auto complaint = [](const std::string& xml) -> std::string {
    try {
      sensorFrom(xml);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint("<sonar range_max_m='-1'><at/></sonar>"),
            "sensor.xml:1: <sonar range_max_m=\"-1\">: must lie in (0, 100] metres; drop it for the default, 5");
  EXPECT_EQ(complaint("<sonar/>"),
            "sensor.xml:1: <sonar>: has no mounting pose; add <at x_m=\"…\" y_m=\"…\" z_m=\"…\" angle_deg=\"…\"/>");
  EXPECT_EQ(complaint("<sonar model='cone'><at/></sonar>"),
            "sensor.xml:1: <sonar model=\"cone\">: is unknown; accepted are: sector, rays");
  EXPECT_EQ(complaint("<sonar beamwidth_deg='20'><at/></sonar>").find("sensor.xml:1: <sonar>: unknown attribute"), 0u);
  EXPECT_EQ(complaint("<radar/>"),
            "sensor.xml:1: <radar>: is not a sensor; accepted are: sonar, laser, lidar, heat, infrared, bumper, "
            "odometry, compass, "
            "camera, battery, beacons, range_and_bearing, gnss, imu, encoders, ground, light, omni_camera, fiducial, "
            "gripper, "
            "blob_finder, "
            "and the 2005 <sensor>");
}

}  // namespace
}  // namespace robosim
