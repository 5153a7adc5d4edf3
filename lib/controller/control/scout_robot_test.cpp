#include "control/scout_robot.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

struct Scout {
  FakeHardware hardware;
  Robot robot{hardware};
  ScoutRobot scout{robot};

  void steps(int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      scout.gs();
    }
  }
};

TEST(ScoutRobot, UsesTenthsOfInchesAndOfDegrees) {
  Scout s;
  s.scout.vm(100, 450);  // 10 inches/s, 45 deg/s
  s.steps(20);
  EXPECT_NEAR(s.hardware.odometry().speed_mps, 0.254, 1e-9);
  EXPECT_NEAR(s.hardware.odometry().turn_radps, M_PI / 4, 1e-9);
}

TEST(ScoutRobot, TurnsWithTheNomadsTrackWidth) {
  // Nomadic: a wheel covers 0.118597 inches a degree, so 45 deg/s is 5.337 inches/s more on the right than the
  // centre's.
  Scout s;
  s.scout.vm(100 + 53, 100 - 53, 0);
  s.steps(20);
  EXPECT_NEAR(s.hardware.odometry().speed_mps, 0.254, 1e-9);
  EXPECT_NEAR(toDegrees(s.hardware.odometry().turn_radps), 5.3 / 0.118597, 1e-6);
  EXPECT_EQ(s.scout.State[STATE_VEL_RIGHT], 153);
  EXPECT_EQ(s.scout.State[STATE_VEL_LEFT], 47);
  EXPECT_EQ(s.scout.State[STATE_MOTOR_STATUS], 1);
}

TEST(ScoutRobot, MovesByADistanceAndAnAngle) {
  Scout s;
  s.scout.pr(200, 0);
  s.steps(60);
  EXPECT_EQ(s.scout.State[STATE_CONF_X], 200);
  EXPECT_EQ(s.scout.State[STATE_CONF_Y], 0);
  s.scout.pr(0, -900);
  s.steps(60);
  EXPECT_EQ(s.scout.State[STATE_CONF_STEER], 2700);
  EXPECT_EQ(s.scout.State[STATE_MOTOR_STATUS], 0);
}

TEST(ScoutRobot, KeepsToItsSpeedsAndAccelerations) {
  Scout s;
  s.scout.sp(50, 300);
  s.scout.ac(20, 3000);
  s.scout.pr(1000, 0);
  s.steps(6);  // 2 inches/s² for 0.5 s, from the step after the order
  EXPECT_NEAR(s.hardware.odometry().speed_mps / 0.0254, 1.2, 1e-6);
  s.steps(40);
  EXPECT_NEAR(s.hardware.odometry().speed_mps / 0.0254, 5, 1e-6);
  s.scout.sp(100, 100, 0);  // both wheels at most 10 inches/s
  s.scout.ac(300, 300, 0);
  s.steps(10);
  EXPECT_NEAR(s.hardware.odometry().speed_mps / 0.0254, 10, 1e-6);
  s.scout.st();
  s.steps(20);
  EXPECT_EQ(s.hardware.odometry().speed_mps, 0);
}

TEST(ScoutRobot, ReadsTheSonarsThatAreOn) {
  Scout s;
  s.hardware.setSonarRange(0, 1.016);  // 40 inches
  s.hardware.setSonarRange(5, 0.508);
  s.scout.gs();
  EXPECT_EQ(s.scout.State[STATE_SONAR_0], 400);
  EXPECT_EQ(s.scout.State[STATE_SONAR_0 + 5], 200);
  const int order[] = {5, 255, 0};
  s.scout.conf_sn(15, order);
  s.hardware.setSonarRange(0, 2.54);
  s.hardware.setSonarRange(5, 2.54);
  s.scout.get_sn();
  EXPECT_EQ(s.scout.State[STATE_SONAR_0], 400);
  EXPECT_EQ(s.scout.State[STATE_SONAR_0 + 5], 1000);
}

TEST(ScoutRobot, MeasuresItsPoseFromDpAndDa) {
  Scout s;
  s.hardware.mutableOdometry().odom_from_robot = {1, 1, M_PI / 2};
  s.scout.dp(100, -50);
  s.scout.da(0);
  s.scout.gs();
  EXPECT_EQ(s.scout.State[STATE_CONF_X], 100);
  EXPECT_EQ(s.scout.State[STATE_CONF_Y], -50);
  EXPECT_EQ(s.scout.State[STATE_CONF_STEER], 0);
  s.hardware.mutableOdometry().odom_from_robot = {1, 1 + 0.254, M_PI / 2};  // ten inches straight ahead
  s.scout.gs();
  EXPECT_EQ(s.scout.State[STATE_CONF_X], 200);
}

TEST(ScoutRobot, ReportsAStall) {
  Scout s;
  s.scout.vm(100, 0);
  s.hardware.blocked = true;
  s.steps(2);
  EXPECT_EQ(s.scout.State[STATE_ERROR], 1);
}

TEST(ScoutRobot, WaitsOnlyWithAClock) {
  Scout s;
  s.scout.pr(100, 0);
  EXPECT_THROW(s.scout.ws(true, false, false, 0), std::logic_error);
}

TEST(ScoutRobot, WaitsForTheEndOfAMoveInALoop) {
  FakeHardware hardware;
  Robot robot(hardware);
  long x = 0, steer = 0;
  int timed_out = -1;
  BlockingController controller([&](Robot& r, StepClock& clock) {
    ScoutRobot scout(r, clock);
    scout.pr(300, 0);
    scout.ws(true, true, false, 0);
    scout.pr(0, 900);
    scout.ws(true, true, false, 60);
    scout.gs();
    x = scout.State[STATE_CONF_X];
    steer = scout.State[STATE_CONF_STEER];
    scout.pr(100000, 0);
    timed_out = scout.ws(true, false, false, 1) == 0;
  });
  for (int i = 0; i < 400 && robot.activity() == Activity::active; ++i) {
    controller.step(robot);
    hardware.advance();
  }
  EXPECT_EQ(robot.activity(), Activity::halted);
  EXPECT_EQ(x, 300);
  EXPECT_EQ(steer, 900);
  EXPECT_EQ(timed_out, 1);
}

TEST(ScoutRobot, GetsNewStateEveryTimeInALoop) {
  FakeHardware hardware;
  Robot robot(hardware);
  std::vector<std::uint64_t> steps;
  BlockingController controller([&](Robot& r, StepClock& clock) {
    ScoutRobot scout(r, clock);
    for (;;) {
      scout.gs();
      steps.push_back(r.stepNumber());
    }
  });
  for (int i = 0; i < 3; ++i) {
    controller.step(robot);
    hardware.advance();
  }
  EXPECT_EQ(steps, (std::vector<std::uint64_t>{0, 1, 2}));
}

}  // namespace
}  // namespace robosim
