#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/infrared.h"
#include "sensors/laser.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr double kRayTolerance_m = 1e-6;

TEST(Laser, ScansASquareRoomFromRightToLeft) {
  // The robot is in the middle of a room of 4 m × 4 m; beam i of 181 faces i - 90 degrees.
  SingleRobotScene robot({block(2.5, 0, 1, 6), block(-2.5, 0, 1, 6), block(0, 2.5, 6, 1), block(0, -2.5, 6, 1)});
  const auto ranges = robot.ranges(*sensorFrom("<laser/>"));
  ASSERT_EQ(ranges.size(), 181u);
  for (int i = 0; i <= 180; ++i) {
    const double angle = toRadians(i - 90);
    const double wall = 2 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    EXPECT_NEAR(ranges[static_cast<std::size_t>(i)], wall, kRayTolerance_m) << i;
  }
}

TEST(Laser, StartsAtItsMountingPoseAndReportsPointsInTheRobotsFrame) {
  SingleRobotScene robot({block(2.5, 0, 1, 6)}, {1, 0, 0});
  const auto laser = sensorFrom("<laser x_m='0.1' z_m='0.25' beams='1'/>");
  const auto echo = std::get<Echoes>(robot.sense(*laser))[0];
  EXPECT_NEAR(echo.range_m, 0.9, kRayTolerance_m);
  EXPECT_NEAR(echo.point_m.x, 1.0, kRayTolerance_m);
  EXPECT_NEAR(echo.point_m.z, 0.25, kRayTolerance_m);
}

TEST(Laser, Format2005IsOnePanningBeamThatReadsTheRangePlusOneUnitWithoutHit) {
  SingleRobotScene robot({block(0, 2.5, 6, 1)});
  const auto laser =
      sensorFrom("<sensor><type>laser</type><position><x-relative>1</x-relative><range>20</range></position></sensor>",
                 Mount{0.1, 0.2, 0.3});
  EXPECT_NEAR(robot.ranges(*laser)[0], 2.1, kRayTolerance_m) << "nothing ahead: 20 + 1 units";
  robot.laser_pan_rad = static_cast<float>(M_PI_2);
  const auto echo = std::get<Echoes>(robot.sense(*laser))[0];
  EXPECT_NEAR(echo.range_m, 2.1, kRayTolerance_m) << "the wall is 2 m to the left, not nearer than 20 units";
  robot.world_from_robot = {0, 0.5, 0};
  EXPECT_NEAR(robot.ranges(*laser)[0], 1.5, kRayTolerance_m);
}

TEST(Laser, IgnoresThePanWithoutThePansFlag) {
  SingleRobotScene robot({block(0, 2.5, 6, 1)});
  robot.laser_pan_rad = static_cast<float>(M_PI_2);
  EXPECT_NEAR(robot.ranges(*sensorFrom("<laser beams='1'/>"))[0], 8, kRayTolerance_m);
}

TEST(Laser, NoiseHasTheDataSheetsSpread) {
  SingleRobotScene robot({block(2.5, 0, 1, 6)});
  const auto laser = sensorFrom("<laser beams='1'><noise/></laser>");
  double squares = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) squares += std::pow(robot.ranges(*laser)[0] - 2, 2);
  EXPECT_NEAR(std::sqrt(squares / n), 0.005, 0.0003);
}

TEST(Infrared, ReadsItsRangeWithoutHit) {
  const auto infrared = sensorFrom("<infrared><at x_m='0.2'/><at x_m='-0.2' angle_deg='180'/></infrared>");
  const auto ranges = SingleRobotScene({block(1.2, 0, 1, 6)}).ranges(*infrared);  // its face 0.7 m ahead of the centre
  EXPECT_NEAR(ranges[0], 0.5, kRayTolerance_m);
  EXPECT_NEAR(ranges[1], 0.8, kRayTolerance_m);
}

TEST(Infrared, NoiseOfTheDataSheetIsTwoPercentOfTheRange) {
  constexpr int kSamples = 4000;
  for (const double range_m : {0.2, 0.6}) {
    SingleRobotScene robot({block(range_m + 0.5, 0, 1, 6)});
    const auto infrared = sensorFrom("<infrared><at/><noise/></infrared>");
    double sum_m = 0;
    double squares_m2 = 0;
    for (int i = 0; i < kSamples; ++i) {
      const double error_m = robot.ranges(*infrared)[0] - range_m;
      sum_m += error_m;
      squares_m2 += error_m * error_m;
    }
    const double std_m = 0.02 * range_m;
    EXPECT_NEAR(sum_m / kSamples, 0, 4 * std_m / 63) << range_m;
    EXPECT_NEAR(std::sqrt(squares_m2 / kSamples), std_m, 4 * std_m / 89) << range_m;
  }
}

TEST(Infrared, DropsTheGivenShareOfItsEchoes) {
  SingleRobotScene robot({block(0.9, 0, 1, 6)});
  const auto infrared = sensorFrom("<infrared><at/><noise dropout='0.25' std_per_m='0'/></infrared>");
  constexpr int kSamples = 4000;
  int dropped = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double range_m = robot.ranges(*infrared)[0];
    EXPECT_NEAR(range_m, range_m > 0.6 ? 0.8 : 0.4, kRayTolerance_m) << "an echo is exact, or absent";
    dropped += range_m > 0.6;
  }
  EXPECT_NEAR(dropped, 1000, 4 * 27.4) << "standard deviation sqrt(4000 * 0.25 * 0.75) = 27.4";
}

TEST(Laser, ReportsTheLargestStandardDeviationOfItsRanges) {
  EXPECT_EQ(sensorFrom("<laser beams='2' range_max_m='8'/>")->info().noise_std_m, 0);
  // 0.01 m + 8 m × 0.02
  const auto laser = sensorFrom("<laser beams='2' range_max_m='8'><noise std_m='0.01' std_per_m='0.02'/></laser>");
  EXPECT_DOUBLE_EQ(laser->info().noise_std_m, 0.17);
  const auto sonar = sensorFrom("<sonar range_max_m='5'><at/><noise std_m='0' std_per_m='0.01'/></sonar>");
  EXPECT_DOUBLE_EQ(sonar->info().noise_std_m, 0.05);
}

}  // namespace
}  // namespace robosim
