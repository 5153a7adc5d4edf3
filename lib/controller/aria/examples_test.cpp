// The examples of doc/controllers.md: that they compile, that they do what they say, and that the page shows this code.
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "aria/pioneer_robot.h"
#include "aria/stock_actions.h"
#include "control/blocking_controller.h"
#include "control/controller.h"
#include "control/scout_robot.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

/// Drives ahead, and turns left at obstacles.
class Bouncer : public Controller {
 public:
  void step(Robot& robot) override {
    bool near = false;
    for (const Echo& echo : robot.sonar()) near |= echo.range_m < 0.5 && echo.point_m.x > 0;
    robot.drive(near ? 0 : 0.3, near ? 0.8 : 0);  // m/s, rad/s
  }
};

/// Wanders as ARIA's demo does: actions of higher priority first.
class AriaWanderer : public Controller {
 public:
  void step(Robot& robot) override {
    if (!pioneer_) {
      pioneer_.emplace(robot);
      pioneer_->addAction(recover_, 100);
      pioneer_->addAction(avoid_front_, 50);
      pioneer_->addAction(drive_, 10);
    }
    pioneer_->update();
  }

 private:
  ActionStallRecover recover_;
  ActionAvoidFront avoid_front_;
  ActionConstantVelocity drive_;
  std::optional<PioneerRobot> pioneer_;
};

/// Wanders, turns away from obstacles, and halts at the gold.
void lookForGold(Robot& robot, StepClock& clock) {
  PioneerRobot pioneer(robot, clock);
  for (;;) {
    pioneer.acquireSensorReadings(PioneerRobot::SONAR | PioneerRobot::HEAT);
    while (!pioneer.isSonarNew() || !pioneer.isHeatNew()) pioneer.waitForNextStep();
    if (pioneer.getHeat() > 10) {
      robot.halt(Activity::found);
      return;
    }
    if (pioneer.getClosestSonarRange(-60, 60) < 500) {
      pioneer.setVel(0);
      pioneer.setRotVel(40);
    } else {
      pioneer.setVel(300);
      pioneer.setRotVel(0);
    }
  }
}

/// Drives a square of ten inches, and backs up when blocked.
void driveSquare(Robot& robot, StepClock& clock) {
  ScoutRobot scout(robot, clock);
  scout.sp(80, 450);
  for (int side = 0; side < 4; ++side) {
    scout.pr(100, 0);
    if (!scout.ws(true, true, false, 20)) scout.pr(-50, 0);
    scout.pr(0, 900);
    scout.ws(true, true, false, 20);
  }
  scout.gs();
}

std::string contentsOf(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(std::string(ROBOSIM_SOURCE_DIR) + "/" + file).rdbuf();
  return text.str();
}

struct Trial {
  FakeHardware hardware;
  Robot robot{hardware};

  void steps(Controller& controller, int n) {
    for (int i = 0; i < n; ++i) {
      controller.step(robot);
      hardware.advance();
    }
  }
};

TEST(ControllerExamples, MatchTheDocumentation) {
  const std::string page = contentsOf("doc/controllers.md"), code = contentsOf("lib/controller/aria/examples_test.cpp");
  const std::string fence = "```cpp\n";
  int examples = 0;
  for (auto at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    const std::string example = page.substr(at, page.find("```", at) - at);
    EXPECT_NE(code.find(example), std::string::npos) << "not in this file, word for word:\n" << example;
    ++examples;
  }
  EXPECT_EQ(examples, 4);
}

TEST(ControllerExamples, BouncerTurnsBeforeAnObstacle) {
  Trial trial;
  Bouncer bouncer;
  trial.steps(bouncer, 20);
  EXPECT_NEAR(trial.hardware.odometry().speed_mps, 0.3, 1e-9);
  trial.hardware.setSonarRange(0, 0.4);
  trial.steps(bouncer, 10);
  EXPECT_EQ(trial.hardware.odometry().speed_mps, 0);
  EXPECT_NEAR(trial.hardware.odometry().turn_radps, 0.8, 1e-9);
}

TEST(ControllerExamples, AriaWandererDrivesUntilSomethingIsNear) {
  Trial trial;
  AriaWanderer wanderer;
  trial.steps(wanderer, 20);
  EXPECT_NEAR(trial.hardware.odometry().speed_mps, 0.4, 1e-9);
  trial.hardware.setSonarRange(1, 0.2);
  trial.steps(wanderer, 10);
  EXPECT_EQ(trial.hardware.odometry().speed_mps, 0);
  EXPECT_LT(trial.hardware.odometry().odom_from_robot.phi, -0.2);
}

TEST(ControllerExamples, LookForGoldHaltsWhereItIsHot) {
  Trial trial;
  BlockingController controller(lookForGold);
  trial.steps(controller, 20);
  EXPECT_NEAR(trial.hardware.odometry().speed_mps, 0.3, 1e-9);
  trial.hardware.setHeat(10.5);
  trial.steps(controller, 3);
  EXPECT_EQ(trial.robot.activity(), Activity::found);
}

TEST(ControllerExamples, DriveSquareEndsWhereItBegan) {
  Trial trial;
  BlockingController controller(driveSquare);
  trial.steps(controller, 400);
  EXPECT_EQ(trial.robot.activity(), Activity::halted);
  EXPECT_NEAR(trial.hardware.odometry().odom_from_robot.x, 0, 1e-3);
  EXPECT_NEAR(trial.hardware.odometry().odom_from_robot.y, 0, 1e-3);
}

}  // namespace
}  // namespace robosim
