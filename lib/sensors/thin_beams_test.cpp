#include <cmath>

#include <gtest/gtest.h>

#include "sensors/infrared.h"
#include "sensors/laser.h"
#include "sensors/one_robot.h"

namespace robosim {
namespace {

constexpr double kFloat = 1e-6;

TEST(Laser, ScansFromRightToLeftAndSeesASquareRoom) {
  // The robot stands in the middle of a room of 4 m × 4 m; beam i of 181 looks along i - 90 degrees.
  OneRobot robot({block(2.5, 0, 1, 6), block(-2.5, 0, 1, 6), block(0, 2.5, 6, 1), block(0, -2.5, 6, 1)});
  const auto ranges = robot.ranges(*sensorFrom("<laser/>"));
  ASSERT_EQ(ranges.size(), 181u);
  for (int i = 0; i <= 180; ++i) {
    const double angle = (i - 90) * M_PI / 180;
    const double wall = 2 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    EXPECT_NEAR(ranges[static_cast<std::size_t>(i)], wall, kFloat) << i;
  }
}

TEST(Laser, StartsWhereItIsMountedAndTellsThePointInTheRobotsFrame) {
  OneRobot robot({block(2.5, 0, 1, 6)}, {1, 0, 0});
  const auto laser = sensorFrom("<laser x_m='0.1' z_m='0.25' beams='1'/>");
  const auto echo = std::get<Echoes>(robot.sense(*laser))[0];
  EXPECT_NEAR(echo.range_m, 0.9, kFloat);
  EXPECT_NEAR(echo.point_m.x, 1.0, kFloat);
  EXPECT_NEAR(echo.point_m.z, 0.25, kFloat);
}

TEST(Laser, Of2005IsOneBeamThatTurnsAndReadsOneUnitMoreThanItsRangeWhenItMeetsNothing) {
  OneRobot robot({block(0, 2.5, 6, 1)});
  const auto laser =
      sensorFrom("<sensor><type>laser</type><position><x-relative>1</x-relative><range>20</range></position></sensor>",
                 Mount{0.1, 0.2, 0.3});
  EXPECT_NEAR(robot.ranges(*laser)[0], 2.1, kFloat) << "nothing ahead: 20 + 1 units";
  robot.laser_pan_rad = static_cast<float>(M_PI_2);
  const auto echo = std::get<Echoes>(robot.sense(*laser))[0];
  EXPECT_NEAR(echo.range_m, 2.1, kFloat) << "the wall is 2 m to the left, not nearer than 20 units";
  robot.world_from_robot = {0, 0.5, 0};
  EXPECT_NEAR(robot.ranges(*laser)[0], 1.5, kFloat);
}

TEST(Laser, ThatDoesNotPanIgnoresThePan) {
  OneRobot robot({block(0, 2.5, 6, 1)});
  robot.laser_pan_rad = static_cast<float>(M_PI_2);
  EXPECT_NEAR(robot.ranges(*sensorFrom("<laser beams='1'/>"))[0], 8, kFloat);
}

TEST(Laser, NoiseHasTheDataSheetsSpread) {
  OneRobot robot({block(2.5, 0, 1, 6)});
  const auto laser = sensorFrom("<laser beams='1'><noise/></laser>");
  double squares = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) squares += std::pow(robot.ranges(*laser)[0] - 2, 2);
  EXPECT_NEAR(std::sqrt(squares / n), 0.005, 0.0003);
}

TEST(Infrared, SeesShortAndReadsItsRangeWhenItSeesNothing) {
  const auto infrared = sensorFrom("<infrared><at x_m='0.2'/><at x_m='-0.2' angle_deg='180'/></infrared>");
  const auto ranges = OneRobot({block(1.2, 0, 1, 6)}).ranges(*infrared);  // its face 0.7 m ahead of the centre
  EXPECT_NEAR(ranges[0], 0.5, kFloat);
  EXPECT_NEAR(ranges[1], 0.8, kFloat);
}

}  // namespace
}  // namespace robosim
