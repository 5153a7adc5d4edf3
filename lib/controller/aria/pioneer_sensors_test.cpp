#include "aria/pioneer_sensors.h"

#include <gtest/gtest.h>

#include "aria/pioneer_robot.h"
#include "base/angle_units.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

TEST(PioneerSensors, ReturnAriasValuesWithoutTheSensor) {
  FakeHardware hardware;
  Robot robot(hardware);
  const PioneerSensors sensors(robot);
  EXPECT_EQ(sensors.getBatteryVoltage(), 13);
  EXPECT_FALSE(sensors.haveStateOfCharge());
  EXPECT_EQ(sensors.getStateOfCharge(), 0);
  EXPECT_EQ(sensors.getCompass(), 0);
  EXPECT_FALSE(sensors.isEStopPressed());
  EXPECT_FALSE(sensors.hasFrontBumpers());
  EXPECT_FALSE(sensors.getBumpDirection(true));
  EXPECT_EQ(sensors.getStallValue(), 0);
}

TEST(PioneerSensors, ReportCompassAndBattery) {
  FakeHardware hardware;
  hardware.addSensor(SensorKind::battery, {}, Scalar{12.5});
  const std::size_t compass = hardware.addSensor(SensorKind::compass, {}, Scalar{-90 * kRadPerDeg});
  Robot robot(hardware);
  const PioneerSensors sensors(robot);
  EXPECT_EQ(sensors.getBatteryVoltage(), 12.5);
  EXPECT_NEAR(sensors.getCompass(), 270, 1e-9);
  hardware.mutableReadings().measurements[compass] = Scalar{45 * kRadPerDeg};
  EXPECT_NEAR(sensors.getCompass(), 45, 1e-9);
}

TEST(PioneerSensors, ReportTheStateOfTheBase) {
  FakeHardware hardware;
  hardware.base_link.emplace();
  hardware.base_link->state = {.motors_enabled = false,
                               .estop_pressed = true,
                               .left_stalled = false,
                               .right_stalled = true,
                               .charge_percent = 80};
  Robot robot(hardware);
  PioneerRobot pioneer(robot);
  EXPECT_TRUE(pioneer.isEStopPressed());
  EXPECT_TRUE(pioneer.haveStateOfCharge());
  EXPECT_EQ(pioneer.getStateOfCharge(), 80);
  EXPECT_FALSE(pioneer.isLeftMotorStalled());
  EXPECT_TRUE(pioneer.isRightMotorStalled());
  EXPECT_EQ(pioneer.getStallValue(), 0x0100);
  EXPECT_FALSE(pioneer.areMotorsEnabled());
  pioneer.enableMotors();
  pioneer.disableSonar();
  EXPECT_TRUE(pioneer.areMotorsEnabled());
  EXPECT_FALSE(hardware.base_link->sonar_on);
}

TEST(PioneerSensors, NumberBumpersClockwiseFromTheLeft) {
  FakeHardware hardware;
  // Front: 60° (0), 0° (1), -60° (2). Behind, from right to left: -120° (0), 180° (1), 120° (2).
  const std::size_t slot = hardware.addSensor(
      SensorKind::bumper, {0, 60 * kRadPerDeg, 120 * kRadPerDeg, 180 * kRadPerDeg, -120 * kRadPerDeg, -60 * kRadPerDeg},
      Contacts{{0, 0, 0, 0, 0, 0}});
  Robot robot(hardware);
  const PioneerSensors sensors(robot);
  EXPECT_EQ(sensors.getNumFrontBumpers(), 3);
  EXPECT_EQ(sensors.getNumRearBumpers(), 3);
  const auto press = [&](const std::vector<std::uint8_t>& pressed) {
    hardware.mutableReadings().measurements[slot] = Contacts{pressed};
  };
  press({0, 1, 0, 0, 0, 0});
  EXPECT_EQ(sensors.getStallValue(), 0x0200);
  EXPECT_NEAR(*sensors.getBumpDirection(true), 60, 1e-9);
  EXPECT_FALSE(sensors.getBumpDirection(false));
  press({1, 0, 0, 0, 0, 1});
  EXPECT_EQ(sensors.getStallValue(), 0x0C00);
  EXPECT_NEAR(*sensors.getBumpDirection(true), -30, 1e-9);
  press({0, 0, 1, 0, 1, 0});
  EXPECT_EQ(sensors.getStallValue(), 0x000A);
  EXPECT_NEAR(*sensors.getBumpDirection(false), 180, 1e-9);
  press({0, 0, 0, 1, 0, 0});
  EXPECT_EQ(sensors.getStallValue(), 0x0004);
}

TEST(PioneerSensors, FindTheTurnTowardsAPlace) {
  FakeHardware hardware;
  hardware.mutableOdometry().odom_from_robot = {1, 0, 170 * kRadPerDeg};
  Robot robot(hardware);
  const PioneerSensors sensors(robot);
  const PioneerPose place{.x = 1000, .y = -500, .th = 0};
  EXPECT_NEAR(sensors.findDistanceTo(place), 500, 1e-9);
  EXPECT_NEAR(sensors.findAngleTo(place), -90, 1e-9);
  EXPECT_NEAR(sensors.findDeltaHeadingTo(place), 100, 1e-9);
}

TEST(PioneerSensors, TransformBetweenItsFrames) {
  FakeHardware hardware;
  hardware.mutableOdometry().odom_from_robot = {1, 2, 0};
  Robot robot(hardware);
  PioneerRobot pioneer(robot);
  pioneer.moveTo({.x = 0, .y = 0, .th = 90});
  EXPECT_EQ(pioneer.getEncoderPose(), (PioneerPose{.x = 1000, .y = 2000, .th = 0}));
  const PioneerPose there = pioneer.getEncoderTransform().doTransform(pioneer.getEncoderPose());
  EXPECT_NEAR(there.findDistanceTo(pioneer.getPose()), 0, 1e-9);
  EXPECT_NEAR(there.th, 90, 1e-9);
  const PioneerPose ahead = pioneer.getToGlobalTransform().doTransform({.x = 100, .y = 0, .th = 0});
  EXPECT_NEAR(ahead.x, 0, 1e-9);
  EXPECT_NEAR(ahead.y, 100, 1e-9);
}

TEST(PioneerSensors, ReturnLaserReadings) {
  FakeHardware hardware;
  Robot robot(hardware);
  PioneerRobot pioneer(robot);
  EXPECT_FALSE(pioneer.hasLaserEcho(0));
  hardware.setLaserRange(2);
  pioneer.moveTo({.x = 0, .y = 0, .th = 90});
  EXPECT_TRUE(pioneer.hasLaserEcho(0));
  const auto reading = pioneer.getLaserReading();
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->getRange(), 2000);
  EXPECT_NEAR(reading->getSensorX(), 100, 1e-9);
  EXPECT_NEAR(reading->getLocalX(), 2100, 1e-3);
  EXPECT_NEAR(reading->getY(), 2100, 1e-3);
  EXPECT_FALSE(pioneer.getLaserReading(1));
  EXPECT_FALSE(pioneer.hasLaserEcho(1));
}

}  // namespace
}  // namespace robosim
