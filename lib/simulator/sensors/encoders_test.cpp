#include "sensors/encoders.h"

#include <gtest/gtest.h>

#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

std::vector<double> valuesOf(SingleRobotScene& robot, const Sensor& sensor) {
  return std::get<Values>(robot.sense(sensor)).values;
}

TEST(Encoders, SumTheAnglesOfBothWheels) {
  const auto encoders = sensorFrom("<encoders wheel_radius_m='0.1' wheelbase_m='0.4'/>");
  SingleRobotScene robot({});
  robot.motion = {0.05, 0};
  EXPECT_EQ(valuesOf(robot, *encoders), (std::vector{0.5, 0.5, 5.0, 5.0}));  // rad, rad, rad/s, rad/s in 0.1 s
  robot.motion = {0, 0.25};  // on the spot to the left: the left wheel by −0.25 · 0.2 / 0.1
  EXPECT_EQ(valuesOf(robot, *encoders), (std::vector{0.0, 1.0, -5.0, 5.0}));
}

TEST(Encoders, HaveTheErrorsOfTheWheels) {
  // A right wheel twice as large as the left one turns half as far; the mean diameter is exact.
  const auto encoders =
      sensorFrom("<encoders wheel_radius_m='0.1' wheelbase_m='0.4'><noise diameter_ratio='2'/></encoders>");
  SingleRobotScene robot({});
  robot.motion = {0.04, 0};
  const auto values = valuesOf(robot, *encoders);
  EXPECT_NEAR(values[0], 0.6, 1e-12);
  EXPECT_NEAR(values[1], 0.3, 1e-12);
}

}  // namespace
}  // namespace robosim
