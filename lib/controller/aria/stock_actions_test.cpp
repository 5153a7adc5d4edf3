#include "aria/stock_actions.h"

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

// The fake robot has a radius of 250 mm, and sonar i looks along i · 22.5° from its edge: a sonar's range is the room.
struct StockActions : testing::Test {
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

TEST_F(StockActions, AvoidFrontTurnsFromTheNearerSideUntilThePathIsFree) {
  ActionAvoidFront avoid;
  EXPECT_EQ(avoid.fire(pioneer, {}).getVelStrength(), ActionDesired::NO_STRENGTH);
  hardware.setSonarRange(2, 0.36);  // 45° to the left, at 80 % of 450 mm
  ActionDesired desired = avoid.fire(pioneer, {});
  EXPECT_DOUBLE_EQ(desired.getDeltaHeading(), -15);
  EXPECT_NEAR(desired.getVel(), 160, 1e-3);
  hardware.setSonarRange(14, 0.2);  // now the right is nearer: it keeps turning right, and stops for what is that near
  desired = avoid.fire(pioneer, {});
  EXPECT_DOUBLE_EQ(desired.getDeltaHeading(), -15);
  EXPECT_EQ(desired.getVel(), 0);
  hardware.clearEchoes();
  EXPECT_EQ(avoid.fire(pioneer, {}).getDeltaHeadingStrength(), ActionDesired::NO_STRENGTH);
  hardware.setSonarRange(14, 0.3);
  EXPECT_DOUBLE_EQ(avoid.fire(pioneer, {}).getDeltaHeading(), 15);
}

TEST_F(StockActions, AvoidSideSteersAwayFromAWall) {
  ActionAvoidSide avoid;
  hardware.setSonarRange(4, 0.2);
  EXPECT_DOUBLE_EQ(avoid.fire(pioneer, {}).getDeltaHeading(), -5);
  hardware.setSonarRange(12, 0.2);  // walls on both sides: no use
  EXPECT_EQ(avoid.fire(pioneer, {}).getDeltaHeadingStrength(), ActionDesired::NO_STRENGTH);
  hardware.setSonarRange(4, 0.4);
  EXPECT_DOUBLE_EQ(avoid.fire(pioneer, {}).getDeltaHeading(), 5);
}

TEST_F(StockActions, ConstantVelocityDrives) {
  ActionConstantVelocity drive;
  EXPECT_EQ(drive.fire(pioneer, {}).getVel(), 400);
}

TEST_F(StockActions, LimiterForwardsSlowsDownInFrontOfAWall) {
  ActionLimiterForwards limiter;
  EXPECT_GT(limiter.fire(pioneer, {}).getMaxVel(), 1e6);
  hardware.setSonarRange(0, 0.625);  // half way between 250 and 1000
  EXPECT_NEAR(limiter.fire(pioneer, {}).getMaxVel(), 100, 1e-3);
  hardware.setSonarRange(0, 0.2);
  EXPECT_EQ(limiter.fire(pioneer, {}).getMaxVel(), 0);
  hardware.clearEchoes();
  hardware.setSonarRange(3, 0.2);  // 67.5°, 416 mm to the left: outside the lane
  EXPECT_GT(limiter.fire(pioneer, {}).getMaxVel(), 1e6);
}

TEST_F(StockActions, LimiterBackwardsSlowsDownForObstaclesBehind) {
  ActionLimiterBackwards limiter;
  EXPECT_EQ(limiter.fire(pioneer, {}).getMaxNegVel(), -250);
  hardware.setSonarRange(8, 0.425);  // half way between 250 and 600
  EXPECT_NEAR(limiter.fire(pioneer, {}).getMaxNegVel(), -125, 1e-2);
  hardware.setSonarRange(8, 0.1);
  EXPECT_EQ(limiter.fire(pioneer, {}).getMaxNegVel(), 0);
}

TEST_F(StockActions, TurnTurnsMoreTheMoreTheSpeedIsLimited) {
  ActionTurn turn;
  ActionDesired current;
  EXPECT_EQ(turn.fire(pioneer, current).getDeltaHeadingStrength(), ActionDesired::NO_STRENGTH);
  hardware.setSonarRange(2, 0.5);  // room on the right
  current.setMaxVel(150);
  EXPECT_DOUBLE_EQ(turn.fire(pioneer, current).getDeltaHeading(), -7.5);
  hardware.clearEchoes();
  hardware.setSonarRange(14, 0.5);  // it keeps the side it began with
  current.setMaxVel(0);
  EXPECT_DOUBLE_EQ(turn.fire(pioneer, current).getDeltaHeading(), -15);
}

TEST_F(StockActions, StopOverridesAll) {
  ActionStop stop;
  ActionConstantVelocity drive;
  pioneer.addAction(drive, 10);
  steps(20);
  EXPECT_GT(pioneer.getVel(), 300);
  pioneer.addAction(stop, 99);
  steps(20);
  EXPECT_EQ(pioneer.getVel(), 0);
}

TEST_F(StockActions, GotoReachesItsGoal) {
  ActionGoto go("goto", {.x = 1500, .y = -1000});
  pioneer.addAction(go, 50);
  steps(200);
  EXPECT_TRUE(go.haveAchievedGoal());
  EXPECT_LE(pioneer.getPose().findDistanceTo(go.getGoal()), 100);
  EXPECT_EQ(pioneer.getVel(), 0);
  go.setGoal({.x = -500, .y = 500});
  EXPECT_FALSE(go.haveAchievedGoal());
  steps(300);
  EXPECT_TRUE(go.haveAchievedGoal());
  EXPECT_LE(pioneer.getPose().findDistanceTo({.x = -500, .y = 500}), 100);
}

TEST_F(StockActions, GotoForgetsACancelledGoal) {
  ActionGoto go("goto", {.x = 1500});
  go.cancelGoal();
  EXPECT_EQ(go.fire(pioneer, {}).getVelStrength(), ActionDesired::NO_STRENGTH);
  EXPECT_FALSE(go.haveAchievedGoal());
}

TEST_F(StockActions, StallRecoverReversesAndTurnsToTheFreerSide) {
  ActionStallRecover recover("stall recover", 225, 20);
  ActionConstantVelocity drive;
  pioneer.addAction(recover, 100);
  pioneer.addAction(drive, 10);
  hardware.setSonarRange(0, 0.01);
  hardware.setSonarRange(1, 0.01);  // the right has more room
  hardware.blocked = true;
  steps(2);
  hardware.blocked = false;
  double back = 0;
  for (int i = 0; i < 20; ++i) {
    steps(1);
    back = std::min(back, pioneer.getVel());
  }
  EXPECT_NEAR(back, -150, 1e-6);
  EXPECT_NEAR(pioneer.getTh(), -45, 3);
  steps(30);
  EXPECT_NEAR(pioneer.getVel(), 400, 1e-6);  // and on it goes
}

TEST_F(StockActions, StallRecoverDoesNotReverseAgainstAWall) {
  ActionStallRecover recover;
  hardware.setSonarRange(0, 0.01);
  hardware.setSonarRange(8, 0.2);
  hardware.mutableReadings().stalled = true;
  EXPECT_EQ(recover.fire(pioneer, {}).getVel(), 0);
  hardware.setSonarRange(8, 0.5);
  EXPECT_EQ(recover.fire(pioneer, {}).getVel(), -150);
}

}  // namespace
}  // namespace robosim
