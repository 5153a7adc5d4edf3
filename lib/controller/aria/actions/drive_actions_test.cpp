// Actions by which a person or a program drives: keys, joystick, ratios, input, and their groups.
#include <gtest/gtest.h>

#include "aria/actions/action_group.h"
#include "aria/actions/action_joydrive.h"
#include "aria/actions/action_keydrive.h"
#include "aria/actions/action_ratio_input.h"
#include "aria/pioneer_robot.h"
#include "aria/stock_actions.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

const std::string kUp = "\x1b[A", kDown = "\x1b[B", kRight = "\x1b[C", kLeft = "\x1b[D";

std::string times(int n, const std::string& key) {
  std::string keys;
  for (int i = 0; i < n; ++i) keys += key;
  return keys;
}

/// A joystick whose state the test sets.
struct TestJoystick : JoyHandler {
  std::optional<JoyState> read() override { return state; }
  std::optional<JoyState> state;
};

struct DriveActions : testing::Test {
  FakeHardware hardware;
  Robot robot{hardware};
  std::optional<TextKeys> text;
  std::optional<KeyHandler> keys;
  TestJoystick joystick;
  PioneerRobot pioneer{robot};

  void type(const std::string& typed) {
    text.emplace(typed);
    keys.emplace(*text);
    pioneer.attachKeyHandler(*keys, false);
  }
  void steps(int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      pioneer.update();
    }
  }
};

TEST_F(DriveActions, InputSetsSpeedAndTurn) {
  ActionInput input;
  pioneer.addAction(input, 50);
  EXPECT_EQ(input.fire(pioneer, {}).getVelStrength(), ActionDesired::NO_STRENGTH);
  input.setVel(200);
  input.setRotVel(30);
  EXPECT_EQ(input.fire(pioneer, {}).getVel(), 200);
  EXPECT_EQ(input.fire(pioneer, {}).getRotVel(), 30);
  input.setHeading(90);
  EXPECT_EQ(input.fire(pioneer, {}).getRotVelStrength(), ActionDesired::NO_STRENGTH);
  steps(40);
  EXPECT_NEAR(pioneer.getTh(), 90, 1e-3);
  input.deltaHeadingFromCurrent(-30);
  input.setVel(0);
  steps(40);
  EXPECT_NEAR(pioneer.getTh(), 60, 1e-3);
  input.deactivate();
  input.activate();
  EXPECT_EQ(input.fire(pioneer, {}).getVelStrength(), ActionDesired::NO_STRENGTH);
  EXPECT_EQ(input.fire(pioneer, {}).getDeltaHeadingStrength(), ActionDesired::NO_STRENGTH);
}

TEST_F(DriveActions, KeysChangeTheSpeedInSteps) {
  ActionKeydrive action;
  type("." + times(4, kUp) + kDown + times(20, ".") + " ");  // the first step takes the keys
  pioneer.addAction(action, 50);
  steps(20);
  EXPECT_NEAR(pioneer.getVel(), 75, 1e-6);
  steps(20);
  EXPECT_EQ(pioneer.getVel(), 0);  // the space bar
}

TEST_F(DriveActions, KeysTurnForOneStepUpToTheMaximum) {
  ActionKeydrive action;
  pioneer.addAction(action, 50);
  action.left();
  EXPECT_EQ(action.fire(pioneer, {}).getDeltaHeading(), 8);
  EXPECT_EQ(action.fire(pioneer, {}).getDeltaHeading(), 0);
  for (int i = 0; i < 9; ++i) action.right();
  EXPECT_EQ(action.fire(pioneer, {}).getDeltaHeading(), -24);
  for (int i = 0; i < 30; ++i) action.up();
  EXPECT_EQ(action.fire(pioneer, {}).getVel(), 400);
  action.setSpeeds(300, 10);
  action.setIncrements(50, 20);
  action.down();
  action.left();
  const ActionDesired desired = action.fire(pioneer, {});
  EXPECT_EQ(desired.getVel(), 300);
  EXPECT_EQ(desired.getDeltaHeading(), 10);
}

TEST_F(DriveActions, KeysContinueFromTheSpeedThatOtherActionsLeave) {
  ActionKeydrive action;
  pioneer.addAction(action, 50);
  for (int i = 0; i < 8; ++i) action.up();
  ActionDesired limit, stop;
  limit.setMaxVel(120);
  EXPECT_EQ(action.fire(pioneer, {}).getVel(), 200);
  EXPECT_EQ(action.fire(pioneer, limit).getVel(), 120);
  EXPECT_EQ(action.fire(pioneer, {}).getVel(), 120);
  stop.setVel(0);
  EXPECT_EQ(action.fire(pioneer, stop).getVel(), 120);
  EXPECT_EQ(action.fire(pioneer, {}).getVel(), 0);  // the robot stands
}

TEST_F(DriveActions, KeysAreReleasedByDeactivation) {
  ActionKeydrive first("first"), second("second");
  type(times(9, "."));
  pioneer.addAction(first, 50);
  pioneer.addAction(second, 40);
  steps(1);
  EXPECT_TRUE(keys->hasKeyHandler(KeyHandler::UP));
  first.deactivate();
  EXPECT_FALSE(keys->hasKeyHandler(KeyHandler::UP));
  second.deactivate();
  second.activate();
  steps(1);
  EXPECT_TRUE(keys->hasKeyHandler(KeyHandler::UP));
}

TEST_F(DriveActions, KeysAreReleasedByRemoval) {
  ActionKeydrive action;
  type(times(9, "."));
  pioneer.addAction(action, 50);
  steps(1);
  EXPECT_TRUE(keys->hasKeyHandler(KeyHandler::UP));
  EXPECT_FALSE(pioneer.remAction("joydrive"));
  EXPECT_TRUE(pioneer.remAction("keydrive"));
  EXPECT_FALSE(keys->hasKeyHandler(KeyHandler::UP));
  EXPECT_EQ(action.getRobot(), nullptr);
}

TEST_F(DriveActions, JoystickDrivesWhileAButtonIsPressed) {
  ActionJoydrive action(&joystick);
  EXPECT_FALSE(action.joystickInited());
  EXPECT_EQ(action.fire(pioneer, {}).getVelStrength(), ActionDesired::NO_STRENGTH);
  joystick.state = JoyState{.x = 0.5, .y = -1, .buttons = {false, true}};
  EXPECT_TRUE(action.joystickInited());
  EXPECT_TRUE(joystick.getButton(2));
  EXPECT_FALSE(joystick.getButton(1) || joystick.getButton(3));
  EXPECT_EQ(action.fire(pioneer, {}).getVel(), -400);
  EXPECT_EQ(action.fire(pioneer, {}).getDeltaHeading(), -7.5);  // to the right
  joystick.state->buttons = {false, false, true};
  EXPECT_EQ(action.fire(pioneer, {}).getVel(), 0);
  EXPECT_EQ(action.fire(pioneer, {}).getVelStrength(), 1);
  action.setStopIfNoButtonPressed(false);
  EXPECT_EQ(action.fire(pioneer, {}).getVelStrength(), 0);
  action.setSpeeds(100, 30);
  joystick.state->buttons = {true};
  EXPECT_EQ(action.fire(pioneer, {}).getVel(), -100);
}

TEST_F(DriveActions, RatiosScaleTheSpeeds) {
  ActionRatioInput input;
  input.setParameters(1000, 200, 20, 10, 80);
  input.setRatios(50, 100, 100);
  EXPECT_DOUBLE_EQ(input.fire(pioneer, {}).getVel(), 500);
  EXPECT_DOUBLE_EQ(input.fire(pioneer, {}).getRotVel(), 50);  // halfway between 80 and 20
  input.setThrottleRatio(50);
  EXPECT_DOUBLE_EQ(input.fire(pioneer, {}).getVel(), 250);
  EXPECT_DOUBLE_EQ(input.fire(pioneer, {}).getRotVel(), 32.5);  // half of 65
  input.setRatios(-100, -100, 100);
  EXPECT_DOUBLE_EQ(input.fire(pioneer, {}).getVel(), -200);
  EXPECT_DOUBLE_EQ(input.fire(pioneer, {}).getRotVel(), -10);
  input.setRatios(500, -500, 500);
  EXPECT_EQ(input.getTransRatio(), 100);
  EXPECT_EQ(input.getRotRatio(), -100);
  EXPECT_EQ(input.getThrottleRatio(), 100);
}

TEST_F(DriveActions, RatiosUseTheRobotsLimitsByDefault) {
  ActionRatioInput input;
  pioneer.setTransVelMax(300);
  pioneer.setRotVelMax(50);
  input.setRatios(-100, 100, 100);
  EXPECT_NEAR(input.fire(pioneer, {}).getVel(), -300, 1e-9);
  EXPECT_NEAR(input.fire(pioneer, {}).getRotVel(), 50, 1e-9);
}

TEST_F(DriveActions, RatiosCallBackByPriorityAndUponActivation) {
  ActionRatioInput input;
  std::string log;
  input.addFireCallback("low", 1, [&] { log += "low "; });
  EXPECT_TRUE(input.addFireCallback("high", 9, [&] { log += "high "; }));
  EXPECT_FALSE(input.addFireCallback("high", 9, [] {}));
  const int on = input.addActivateCallback([&] { log += "on "; });
  input.addDeactivateCallback([&] { log += "off "; });
  input.setRatios(10, 10, 10);
  input.fire(pioneer, {});
  input.deactivate();
  input.deactivate();
  input.activate();
  EXPECT_EQ(log, "high low off on ");
  EXPECT_EQ(input.getThrottleRatio(), 0);
  EXPECT_TRUE(input.remFireCallback("low"));
  EXPECT_TRUE(input.remActivateCallback(on));
}

TEST_F(DriveActions, KeysAndJoystickSetRatios) {
  ActionRatioInput input;
  input.setParameters(1000, 1000, 60, 60, 60);
  pioneer.addAction(input, 50);
  type("." + times(3, kUp) + kLeft + "." + kRight + " .");
  RatioInputKeydrive keydrive(input);
  steps(5);
  EXPECT_EQ(input.getTransRatio(), 15);
  EXPECT_EQ(input.getRotRatio(), 0);
  steps(1);
  EXPECT_EQ(input.getRotRatio(), 50);  // for one step
  steps(1);
  EXPECT_EQ(input.getRotRatio(), 0);
  {
    RatioInputJoydrive joydrive(input, joystick, 10);  // after the keys
    joystick.state = JoyState{.x = -1, .y = 0.5, .buttons = {true}};
    steps(1);
    EXPECT_EQ(input.getTransRatio(), 50);
    EXPECT_EQ(input.getRotRatio(), 100);
  }
  steps(2);
  EXPECT_EQ(input.getTransRatio(), 0);  // the space bar
}

TEST_F(DriveActions, GroupsAreSwitchedTogether) {
  ActionGroupInput input(pioneer);
  ActionGroupStop stop(pioneer);
  stop.deactivate();
  input.getActionInput().setVel(300);
  steps(20);
  EXPECT_NEAR(pioneer.getVel(), 300, 1e-6);
  stop.activateExclusive();
  EXPECT_FALSE(input.getActionInput().isActive());
  steps(20);
  EXPECT_EQ(pioneer.getVel(), 0);
  input.activateExclusive();
  EXPECT_FALSE(stop.getActionList()[0]->isActive());
  EXPECT_TRUE(input.remAction(*input.getActionList()[0]));
  EXPECT_EQ(pioneer.findAction("input"), nullptr);
}

TEST_F(DriveActions, GroupsRemoveTheirActionsWhenTheyAreDestroyed) {
  ActionConstantVelocity action("mine");
  {
    ActionGroup group(pioneer);
    group.addAction(action, 10);
    EXPECT_EQ(pioneer.findAction("mine"), &action);
    EXPECT_EQ(group.getActionList().size(), 1u);
    ActionStop other;
    EXPECT_FALSE(group.remAction(other));
  }
  EXPECT_EQ(pioneer.findAction("mine"), nullptr);
}

TEST_F(DriveActions, TeleopStopsBeforeAnObstacleAndUnguardedTeleopDoesNot) {
  hardware.setSonarRange(0, 0.05);  // straight ahead, within the clearance
  type("." + times(10, kUp) + times(30, "."));
  {
    ActionGroupTeleop teleop(pioneer, &joystick);
    steps(12);
    EXPECT_EQ(pioneer.getVel(), 0);
    joystick.state = JoyState{.x = 0, .y = -0.5, .buttons = {true}};
    steps(10);
    EXPECT_NEAR(pioneer.getVel(), -200, 1e-6);
  }
  joystick.state->buttons = {false};
  type("." + times(10, kUp) + times(30, "."));
  ActionGroupUnguardedTeleop unguarded(pioneer, &joystick);
  steps(20);
  EXPECT_NEAR(pioneer.getVel(), 250, 1e-6);
}

}  // namespace
}  // namespace robosim
