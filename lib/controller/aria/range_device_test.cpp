#include "aria/range_device.h"

#include <gtest/gtest.h>

#include "aria/laser_device.h"
#include "aria/pioneer_robot.h"
#include "aria/sonar_device.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

struct RangeDeviceOfARobot : testing::Test {
  FakeHardware hardware;
  Robot robot{hardware};
  PioneerRobot pioneer{robot};

  void steps(int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      pioneer.update();
    }
  }
  void placeAt(double x_m, double y_m, double phi_rad) {
    hardware.mutableOdometry().odom_from_robot = {x_m, y_m, phi_rad};
  }
};

TEST_F(RangeDeviceOfARobot, AnswersInItsFrame) {
  RangeDevice device(10, 10, "virtual wall", 4000);
  pioneer.addRangeDevice(device);
  device.addReading(0, 2000);
  placeAt(0, 1, M_PI / 2);
  double angle = 77;
  PioneerPose place;
  EXPECT_NEAR(device.currentReadingPolar(-10, 10, &angle), 1000, 1e-9);
  EXPECT_NEAR(angle, 0, 1e-9);
  EXPECT_NEAR(device.cumulativeReadingBox(0, -10, 3000, 10, &place), 1000, 1e-9);
  EXPECT_NEAR(place.x, 1000, 1e-9);
  EXPECT_EQ(device.currentReadingPolar(90, 180), 4000);
  EXPECT_EQ(device.currentReadingBox(-1000, -10, 0, 10), 4000);
  EXPECT_EQ(device.cumulativeReadingPolar(90, 180), 4000);
}

TEST_F(RangeDeviceOfARobot, IgnoresPointsBeyondItsMaximumRange) {
  RangeDevice device(10, 10, "near", 1000);
  device.addReading(1500, 0);
  double angle = 77;
  EXPECT_EQ(device.currentReadingPolar(-10, 10, &angle), 1000);
  EXPECT_EQ(angle, 77);
  pioneer.addRangeDevice(device);
  EXPECT_EQ(pioneer.checkRangeDevicesCurrentPolar(-10, 10, &angle), 1000);
  EXPECT_EQ(pioneer.checkRangeDevicesCurrentPolar(-10, 10), 30000);
}

TEST_F(RangeDeviceOfARobot, ForgetsByAgeAndDistance) {
  RangeDevice device(10, 10, "memory", 5000);
  device.setMaxSecondsToKeepCurrent(0.3);
  device.setMaxSecondsToKeepCumulative(0.5);
  pioneer.addRangeDevice(device);
  device.addReading(1000, 0);
  steps(3);
  EXPECT_EQ(device.getCurrentBuffer().size(), 1u);
  steps(1);
  EXPECT_EQ(device.getCurrentBuffer().size(), 0u);
  EXPECT_EQ(device.getCumulativeBuffer().size(), 1u);
  steps(2);
  EXPECT_EQ(device.getCumulativeBuffer().size(), 0u);

  device.addReading(1000, 0);
  device.setMaxDistToKeepCumulative(800);
  placeAt(0.2, 0, 0);
  steps(1);
  EXPECT_EQ(device.getCumulativeBuffer().size(), 1u);
  placeAt(0.19, 0, 0);
  steps(1);
  EXPECT_EQ(device.getCumulativeBuffer().size(), 0u);
}

TEST_F(RangeDeviceOfARobot, ForgetsOnRequest) {
  RangeDevice device(10, 10, "memory", 5000);
  pioneer.addRangeDevice(device);
  device.addReading(1000, 0);
  steps(5);
  device.addReading(2000, 0);
  device.clearCumulativeOlderThan(400);
  ASSERT_EQ(device.getCumulativeBuffer().size(), 1u);
  EXPECT_EQ(device.getCumulativeBuffer()[0].x, 2000);
  device.clearCumulativeReadings();
  device.clearCurrentReadings();
  EXPECT_TRUE(device.getCurrentBuffer().empty() && device.getCumulativeBuffer().empty());
}

TEST_F(RangeDeviceOfARobot, MovesWithTheFrameOfThePose) {
  RangeDevice device(10, 10, "wall", 5000);
  pioneer.addRangeDevice(device);
  device.addReading(1000, 0);
  pioneer.moveTo({.x = 500, .y = 0, .th = 90});
  EXPECT_NEAR(device.getCurrentBuffer()[0].x, 500, 1e-9);
  EXPECT_NEAR(device.getCurrentBuffer()[0].y, 1000, 1e-9);
  EXPECT_NEAR(device.currentReadingPolar(-10, 10), 1000, 1e-9);
  pioneer.moveTo({.x = 0, .y = 0, .th = 0}, false);
  EXPECT_NEAR(device.getCurrentBuffer()[0].x, 1000, 1e-9);
  EXPECT_NEAR(device.getCumulativeBuffer()[0].y, 1000, 1e-9);
}

TEST_F(RangeDeviceOfARobot, IsFoundByName) {
  RangeDevice one(1, 1, "one", 1000), two(1, 1, "two", 2000);
  pioneer.addRangeDevice(one);
  pioneer.addRangeDevice(two);
  pioneer.addRangeDevice(one);
  EXPECT_EQ(pioneer.getRangeDeviceList().size(), 2u);
  EXPECT_EQ(pioneer.findRangeDevice("two"), &two);
  EXPECT_EQ(pioneer.findRangeDevice("three"), nullptr);
  EXPECT_EQ(two.getRobot(), &pioneer);
  EXPECT_TRUE(pioneer.remRangeDevice(two));
  EXPECT_FALSE(pioneer.remRangeDevice(two));
  EXPECT_FALSE(pioneer.hasRangeDevice(two));
  EXPECT_EQ(two.getRobot(), nullptr);
}

TEST_F(RangeDeviceOfARobot, ReturnsTheClosestPointOfAllDevices) {
  RangeDevice one(5, 5, "one", 4000), two(5, 5, "two", 6000);
  pioneer.addRangeDevice(one);
  pioneer.addRangeDevice(two);
  one.addReading(2000, 100);
  two.addReading(1000, 0);
  const RangeDevice* device = nullptr;
  double angle = 0;
  PioneerPose place;
  EXPECT_NEAR(pioneer.checkRangeDevicesCurrentPolar(-20, 20, &angle, &device), 1000, 1e-9);
  EXPECT_EQ(device, &two);
  EXPECT_NEAR(pioneer.checkRangeDevicesCurrentBox(1500, -500, 3000, 500, &place, &device), std::hypot(2000, 100), 1e-9);
  EXPECT_EQ(device, &one);
  EXPECT_NEAR(place.y, 100, 1e-9);
  EXPECT_NEAR(pioneer.checkRangeDevicesCumulativePolar(-20, 20, &angle, &device), 1000, 1e-9);
  EXPECT_NEAR(pioneer.checkRangeDevicesCumulativeBox(0, -50, 3000, 50), 1000, 1e-9);
  EXPECT_EQ(pioneer.checkRangeDevicesCurrentPolar(90, 180, &angle), 4000);
}

TEST_F(RangeDeviceOfARobot, IsNotRequiredForTheEchoesOfThisStep) {
  hardware.setLaserRange(0.9);
  double angle = 77;
  const RangeDevice* device = nullptr;
  EXPECT_NEAR(pioneer.checkRangeDevicesCurrentPolar(-10, 10, &angle, &device), 1000, 1e-3);
  EXPECT_NEAR(angle, 0, 1e-6);
  EXPECT_EQ(pioneer.checkRangeDevicesCumulativePolar(-10, 10), 30000);
}

TEST_F(RangeDeviceOfARobot, SonarDeviceCollectsEchoes) {
  SonarDevice sonar;
  pioneer.addRangeDevice(sonar);
  hardware.setSonarRange(0, 0.75);
  steps(1);
  ASSERT_EQ(sonar.getCurrentBuffer().size(), 1u);
  EXPECT_NEAR(sonar.getCurrentBuffer()[0].x, 1000, 1e-3);
  steps(30);  // the same place: one cumulative point, and as many current ones as fit
  EXPECT_EQ(sonar.getCurrentBuffer().size(), 24u);
  EXPECT_EQ(sonar.getCumulativeBuffer().size(), 1u);
  EXPECT_NEAR(sonar.getCumulativeBuffer()[0].time_s, 3.1, 1e-9);
  hardware.setSonarRange(0, 0.9);
  steps(1);
  EXPECT_EQ(sonar.getCumulativeBuffer().size(), 2u);
  pioneer.disableSonar();
  steps(1);
  EXPECT_NEAR(sonar.getCurrentBuffer()[0].time_s, 3.2, 1e-9);
}

TEST_F(RangeDeviceOfARobot, LaserDeviceKeepsTheLatestScanAndAHistory) {
  LaserDevice laser;
  pioneer.addRangeDevice(laser);
  hardware.setLaserRange(1);  // from 100 mm ahead of the centre
  steps(1);
  hardware.setLaserRange(1.15);
  steps(1);
  ASSERT_EQ(laser.getCurrentBuffer().size(), 1u);
  EXPECT_NEAR(laser.getCurrentBuffer()[0].x, 1250, 1e-3);
  EXPECT_EQ(laser.getCumulativeBuffer().size(), 1u);  // only 150 mm apart
  hardware.setLaserRange(1.5);
  steps(1);
  EXPECT_EQ(laser.getCumulativeBuffer().size(), 2u);
  hardware.setLaserRange(3.5);  // too far to insert
  steps(1);
  EXPECT_EQ(laser.getCumulativeBuffer().size(), 2u);
  ASSERT_EQ(laser.getRawReadings().size(), 1u);
  EXPECT_EQ(laser.getRawReadings()[0].getRange(), 3500);
  hardware.setLaserRange(100);
  steps(1);
  EXPECT_TRUE(laser.getCurrentBuffer().empty());
}

TEST_F(RangeDeviceOfARobot, LaserDeviceRemovesPointsThatABeamPassesThrough) {
  LaserDevice laser;
  pioneer.addRangeDevice(laser);
  hardware.setLaserRange(1);
  steps(1);
  EXPECT_EQ(laser.getCumulativeBuffer().size(), 1u);
  hardware.setLaserRange(1.07);  // within 75 mm of its end: the same wall
  steps(9);
  EXPECT_EQ(laser.getCumulativeBuffer().size(), 1u);
  hardware.setLaserRange(8);
  steps(9);  // the next check is a second after the last
  EXPECT_EQ(laser.getCumulativeBuffer().size(), 1u);
  steps(1);
  EXPECT_EQ(laser.getCumulativeBuffer().size(), 0u);
}

}  // namespace
}  // namespace robosim
