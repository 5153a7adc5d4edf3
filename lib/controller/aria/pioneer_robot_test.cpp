#include "aria/pioneer_robot.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

struct Pioneer {
  FakeHardware hardware;
  Robot robot{hardware};
  PioneerRobot pioneer{robot};

  void steps(int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      pioneer.update();
    }
  }
};

TEST(PioneerRobot, UsesMillimetresAndDegrees) {
  Pioneer p;
  p.pioneer.setVel(300);
  p.pioneer.setRotVel(-45);
  p.steps(20);
  EXPECT_NEAR(p.hardware.odometry().speed_mps, 0.3, 1e-9);
  EXPECT_NEAR(p.hardware.odometry().turn_radps, -M_PI / 4, 1e-9);
  EXPECT_NEAR(p.pioneer.getVel(), 300, 1e-6);
  EXPECT_NEAR(p.pioneer.getRotVel(), -45, 1e-6);
  EXPECT_DOUBLE_EQ(p.pioneer.getRobotRadius(), 250);
}

TEST(PioneerRobot, ConvertsTwoWheelSpeedsAsAria) {
  // ARIA: 300 mm/s left and 100 mm/s right give -32 deg/s.
  Pioneer p;
  p.pioneer.setVel2(300, 100);
  p.steps(30);
  EXPECT_NEAR(p.pioneer.getVel(), 200, 1e-6);
  EXPECT_NEAR(p.pioneer.getRotVel(), -32, 0.1);
  EXPECT_NEAR(p.pioneer.getLeftVel(), 300, 1e-6);
  EXPECT_NEAR(p.pioneer.getRightVel(), 100, 1e-6);
}

TEST(PioneerRobot, MovesADistanceAndReportsCompletion) {
  Pioneer p;
  EXPECT_TRUE(p.pioneer.isMoveDone());
  p.pioneer.move(500);
  EXPECT_FALSE(p.pioneer.isMoveDone());
  p.steps(50);
  EXPECT_TRUE(p.pioneer.isMoveDone());
  EXPECT_TRUE(p.pioneer.isMoveDone(1));
  EXPECT_NEAR(p.pioneer.getX(), 500, 0.1);
}

TEST(PioneerRobot, CompletesAMoveWithin40MillimetresByDefault) {
  Pioneer p;
  p.pioneer.move(39);
  EXPECT_TRUE(p.pioneer.isMoveDone());
  EXPECT_FALSE(p.pioneer.isMoveDone(38));
}

TEST(PioneerRobot, TurnsToAHeadingAndReportsCompletion) {
  Pioneer p;
  p.pioneer.setHeading(90);
  EXPECT_FALSE(p.pioneer.isHeadingDone());
  p.steps(30);
  EXPECT_TRUE(p.pioneer.isHeadingDone(0.1));
  EXPECT_NEAR(p.pioneer.getTh(), 90, 1e-3);
  p.pioneer.setDeltaHeading(-30);
  p.steps(30);
  EXPECT_NEAR(p.pioneer.getTh(), 60, 1e-3);
}

TEST(PioneerRobot, CancelsAMoveWhenASpeedIsSet) {
  Pioneer p;
  p.pioneer.move(5000);
  p.steps(5);
  p.pioneer.setVel(0);
  EXPECT_TRUE(p.pioneer.isMoveDone());
  p.steps(20);
  EXPECT_EQ(p.pioneer.getVel(), 0);
}

TEST(PioneerRobot, StopsTranslationAndRotation) {
  Pioneer p;
  p.pioneer.move(5000);
  p.pioneer.setRotVel(40);
  p.steps(10);
  p.pioneer.stop();
  p.steps(20);
  EXPECT_EQ(p.pioneer.getVel(), 0);
  EXPECT_EQ(p.pioneer.getRotVel(), 0);
}

TEST(PioneerRobot, MeasuresItsPoseFromMoveTo) {
  Pioneer p;
  p.hardware.mutableOdometry().odom_from_robot = {1, 2, M_PI / 2};
  p.pioneer.update();
  p.pioneer.moveTo({.x = 5000, .y = 0, .th = 0});
  EXPECT_NEAR(p.pioneer.getX(), 5000, 1e-6);
  EXPECT_NEAR(p.pioneer.getY(), 0, 1e-6);
  EXPECT_NEAR(p.pioneer.getTh(), 0, 1e-6);
  // One metre along the odometry's y axis is straight ahead.
  p.hardware.mutableOdometry().odom_from_robot = {1, 3, M_PI / 2};
  EXPECT_NEAR(p.pioneer.getX(), 6000, 1e-6);
  p.pioneer.update();
  p.pioneer.setHeading(-90);
  p.steps(40);
  EXPECT_NEAR(p.pioneer.getTh(), -90, 1e-3);
}

TEST(PioneerRobot, ClampsLimitsToTheHardware) {
  Pioneer p;
  EXPECT_TRUE(p.pioneer.setTransVelMax(99999));
  EXPECT_DOUBLE_EQ(p.pioneer.getTransVelMax(), 1000);
  EXPECT_TRUE(p.pioneer.setTransVelMax(200));
  EXPECT_FALSE(p.pioneer.setTransVelMax(-1));
  EXPECT_DOUBLE_EQ(p.pioneer.getTransVelMax(), 200);
  EXPECT_TRUE(p.pioneer.setRotVelMax(10));
  EXPECT_NEAR(p.pioneer.getRotVelMax(), 10, 1e-9);
  p.pioneer.setVel(800);
  p.pioneer.setRotVel(800);
  p.steps(30);
  EXPECT_NEAR(p.pioneer.getVel(), 200, 1e-9);
  EXPECT_NEAR(p.pioneer.getRotVel(), 10, 1e-9);
}

TEST(PioneerRobot, AcceleratesAtItsAcceleration) {
  Pioneer p;
  p.pioneer.setTransAccel(100);
  p.pioneer.setTransDecel(200);
  p.pioneer.setVel(500);
  p.steps(11);  // commanded in the step before it drives
  EXPECT_NEAR(p.pioneer.getVel(), 110, 1e-6);
  p.pioneer.setVel(0);
  p.steps(2);
  EXPECT_NEAR(p.pioneer.getVel(), 70, 1e-6);
}

TEST(PioneerRobot, StandsWhileItsMotorsAreOff) {
  Pioneer p;
  EXPECT_TRUE(p.pioneer.areMotorsEnabled());
  p.pioneer.disableMotors();
  p.pioneer.setVel(500);
  p.steps(10);
  EXPECT_EQ(p.pioneer.getX(), 0);
}

TEST(PioneerRobot, ReportsAStall) {
  Pioneer p;
  EXPECT_EQ(p.pioneer.getStallValue(), 0);
  p.pioneer.setVel(300);
  p.hardware.blocked = true;
  p.steps(2);
  EXPECT_TRUE(p.pioneer.isLeftMotorStalled());
  EXPECT_TRUE(p.pioneer.isRightMotorStalled());
  EXPECT_EQ(p.pioneer.getStallValue(), 0x0101);
}

TEST(PioneerRobot, AnswersARequestInTheNextStep) {
  Pioneer p;
  EXPECT_TRUE(p.pioneer.isSonarNew());  // nothing asked for: every step's readings are new
  p.pioneer.acquireSensorReadings(PioneerRobot::SONAR | PioneerRobot::HEAT);
  EXPECT_FALSE(p.pioneer.isSonarNew());
  EXPECT_FALSE(p.pioneer.isSonarNew(0));
  EXPECT_FALSE(p.pioneer.isHeatNew());
  EXPECT_TRUE(p.pioneer.isLaserNew());
  p.steps(1);
  EXPECT_TRUE(p.pioneer.isSonarNew());
  EXPECT_TRUE(p.pioneer.isSonarNew(15));
  EXPECT_FALSE(p.pioneer.isSonarNew(16));
  EXPECT_TRUE(p.pioneer.isHeatNew());
}

TEST(PioneerRobot, RefusesARequestForAMissingSensor) {
  FakeHardware hardware;
  auto sensors = std::make_shared<std::vector<SensorInfo>>(*hardware.info().sensors);
  sensors->pop_back();  // the heat sensor
  hardware.mutableInfo().sensors = sensors;
  Robot robot(hardware);
  PioneerRobot pioneer(robot);
  try {
    pioneer.acquireSensorReadings(PioneerRobot::SONAR | PioneerRobot::HEAT);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "acquireSensorReadings: robot 'fake' has no heat; give its model one, or do not ask for it");
  }
  EXPECT_FALSE(pioneer.isHeatNew());
}

TEST(PioneerRobot, ReturnsSonarRangesInMillimetres) {
  Pioneer p;
  p.hardware.setSonarRange(4, 0.75);  // looks to the left, from 250 mm beside the centre
  EXPECT_EQ(p.pioneer.getNumSonar(), 16);
  EXPECT_EQ(p.pioneer.getSonarRange(4), 750);
  EXPECT_EQ(p.pioneer.getSonarRange(0), 5000);
  EXPECT_EQ(p.pioneer.getSonarRange(16), -1);
  p.pioneer.moveTo({.x = 100, .y = 200, .th = 90});
  const auto reading = p.pioneer.getSonarReading(4);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->getRange(), 750);
  EXPECT_NEAR(reading->getLocalX(), 0, 1e-3);
  EXPECT_NEAR(reading->getLocalY(), 1000, 1e-3);
  EXPECT_NEAR(reading->getX(), -900, 1e-3);
  EXPECT_NEAR(reading->getY(), 200, 1e-3);
  EXPECT_NEAR(reading->getSensorTh(), 90, 1e-9);
  EXPECT_FALSE(p.pioneer.getSonarReading(-1));
}

TEST(PioneerRobot, FindsTheClosestSonarBetweenTwoAngles) {
  Pioneer p;
  p.hardware.setSonarRange(1, 1.0);   // 22.5°
  p.hardware.setSonarRange(15, 0.8);  // -22.5°
  p.hardware.setSonarRange(8, 0.5);   // 180°
  EXPECT_EQ(p.pioneer.getClosestSonarRange(0, 90), 1000);
  EXPECT_EQ(p.pioneer.getClosestSonarRange(-90, 90), 800);
  EXPECT_EQ(p.pioneer.getClosestSonarNumber(90, -90), 8);  // round the back
  EXPECT_EQ(p.pioneer.getClosestSonarRange(1, 5), -1);     // none looks there
}

TEST(PioneerRobot, HasNoNewReadingsWhileItsSonarIsOff) {
  Pioneer p;
  p.hardware.setSonarRange(0, 1.0);
  p.pioneer.disableSonar();
  EXPECT_FALSE(p.pioneer.isSonarNew(0));
  EXPECT_EQ(p.pioneer.getSonarRange(0), 5000);
  EXPECT_NEAR(p.pioneer.getSonarReading(0)->getLocalX(), 5250, 1e-6);
  p.pioneer.enableSonar();
  EXPECT_EQ(p.pioneer.getSonarRange(0), 1000);
}

TEST(PioneerRobot, FindsEchoesInSectorsAndBoxes) {
  Pioneer p;
  EXPECT_EQ(p.pioneer.checkRangeDevicesCurrentPolar(-180, 180), 30000);
  p.hardware.setSonarRange(2, 0.75);  // 45°: a metre from the centre
  p.hardware.setLaserRange(0.4);      // straight ahead from 0.1 m ahead
  EXPECT_NEAR(p.pioneer.checkRangeDevicesCurrentPolar(30, 60), 1000, 1e-3);
  EXPECT_NEAR(p.pioneer.checkRangeDevicesCurrentPolar(-60, 60), 500, 1e-3);
  EXPECT_EQ(p.pioneer.checkRangeDevicesCurrentPolar(90, -30, 7777), 7777);
  EXPECT_NEAR(p.pioneer.checkRangeDevicesCurrentBox(0, 100, 900, 900), 1000, 1e-3);
  EXPECT_NEAR(p.pioneer.checkRangeDevicesCurrentBox(900, -100, 0, 100), 500, 1e-3);
}

TEST(PioneerRobot, ReadsLaserAndHeat) {
  Pioneer p;
  p.hardware.setLaserRange(2.5);
  p.hardware.setHeat(8.5);
  EXPECT_EQ(p.pioneer.getNumLaser(), 1);
  EXPECT_EQ(p.pioneer.getLaserRange(), 2500);
  EXPECT_EQ(p.pioneer.getLaserRange(1), -1);
  EXPECT_EQ(p.pioneer.getHeat(), 8.5);
  p.pioneer.turnLaser(-45);
  EXPECT_NEAR(p.hardware.lastCommand().laser_pan_rad, -M_PI / 4, 1e-6);
}

TEST(PioneerRobot, WaitsOnlyWithAClock) {
  Pioneer p;
  EXPECT_THROW(p.pioneer.waitForNextStep(), std::logic_error);
}

TEST(PioneerRobot, DrivesAPathWrittenAsALoop) {
  FakeHardware hardware;
  Robot robot(hardware);
  BlockingController controller([](Robot& r, StepClock& clock) {
    PioneerRobot pioneer(r, clock);
    for (int side = 0; side < 4; ++side) {
      pioneer.move(1000);
      while (!pioneer.isMoveDone(1)) pioneer.waitForNextStep();
      pioneer.setDeltaHeading(90);
      while (!pioneer.isHeadingDone(0.1)) pioneer.waitForNextStep();
    }
  });
  double x_max = 0, y_max = 0;
  for (int i = 0; i < 600 && robot.activity() == Activity::active; ++i) {
    controller.step(robot);
    hardware.advance();
    x_max = std::max(x_max, hardware.odometry().odom_from_robot.x);
    y_max = std::max(y_max, hardware.odometry().odom_from_robot.y);
  }
  EXPECT_EQ(robot.activity(), Activity::halted);
  EXPECT_NEAR(x_max, 1, 0.02);
  EXPECT_NEAR(y_max, 1, 0.02);
  EXPECT_NEAR(hardware.odometry().odom_from_robot.x, 0, 0.02);
  EXPECT_NEAR(hardware.odometry().odom_from_robot.y, 0, 0.02);
}

TEST(PioneerRobot, HaltsPermanentlyOnceDisconnected) {
  Pioneer p;
  p.pioneer.setVel(300);
  p.pioneer.disconnect();
  EXPECT_FALSE(p.pioneer.isConnected());
  EXPECT_EQ(p.hardware.lastCommand(), Command{.activity = Activity::halted});
}

}  // namespace
}  // namespace robosim
