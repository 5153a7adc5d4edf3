#include "aria/action.h"

#include <random>

#include <gtest/gtest.h>

#include "aria/pioneer_robot.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

/// Requests the same in every step, and stores the result of the actions of higher priority.
class FixedAction : public Action {
 public:
  FixedAction(std::string name, ActionDesired desired) : Action(std::move(name)), desired_(desired) {}
  ActionDesired fire(PioneerRobot&, const ActionDesired& current) override {
    seen = current;
    return desired_;
  }
  ActionDesired seen;

 private:
  ActionDesired desired_;
};

ActionDesired vel(double value, double strength = 1) {
  ActionDesired desired;
  desired.setVel(value, strength);
  return desired;
}

struct Actions : testing::Test {
  FakeHardware hardware;
  Robot robot{hardware};
  PioneerRobot pioneer{robot};
  ActionList list;
};

TEST_F(Actions, OfHigherPriorityComeFirst) {
  FixedAction low("low", vel(100)), high("high", vel(300));
  list.add(low, 10);
  list.add(high, 90);
  EXPECT_EQ(list.resolve(pioneer).getVel(), 300);
  EXPECT_EQ(low.seen.getVel(), 300);
  EXPECT_EQ(high.seen.getVelStrength(), ActionDesired::NO_STRENGTH);
}

TEST_F(Actions, OfLowerPriorityFillWhatIsLeftOpen) {
  // Half of 400 and half of 100; the third finds nothing open.
  FixedAction first("first", vel(400, 0.5)), second("second", vel(100)), third("third", vel(-900));
  list.add(first, 3);
  list.add(second, 2);
  list.add(third, 1);
  const ActionDesired settled = list.resolve(pioneer);
  EXPECT_DOUBLE_EQ(settled.getVel(), 250);
  EXPECT_DOUBLE_EQ(settled.getVelStrength(), 1);
}

TEST_F(Actions, OfOnePriorityAreAveragedByStrength) {
  FixedAction a("a", vel(100)), b("b", vel(200)), c("c", vel(600, 0.5));
  list.add(a, 5);
  list.add(b, 5);
  list.add(c, 5);
  EXPECT_DOUBLE_EQ(list.resolve(pioneer).getVel(), (100 + 200 + 300) / 2.5);
}

TEST_F(Actions, WithoutDesiredMotionLeaveAllOpen) {
  FixedAction nothing("nothing", {}), go("go", vel(100));
  list.add(nothing, 9);
  list.add(go, 1);
  EXPECT_EQ(list.resolve(pioneer).getVel(), 100);
  EXPECT_EQ(list.resolve(pioneer).getDeltaHeadingStrength(), ActionDesired::NO_STRENGTH);
}

TEST_F(Actions, CannotTurnByAngleAndBySpeedAtOnce) {
  ActionDesired by_angle, by_speed;
  by_angle.setDeltaHeading(20);
  by_speed.setRotVel(50);
  FixedAction angle("angle", by_angle), speed("speed", by_speed);
  list.add(angle, 9);
  list.add(speed, 1);
  EXPECT_EQ(list.resolve(pioneer).getDeltaHeading(), 20);
  EXPECT_EQ(list.resolve(pioneer).getRotVelStrength(), ActionDesired::NO_STRENGTH);
  EXPECT_TRUE(list.remove(angle));
  EXPECT_FALSE(list.remove(angle));
  EXPECT_EQ(list.resolve(pioneer).getRotVel(), 50);
}

TEST_F(Actions, LimitSpeedByTheLowestOfAllLimits) {
  ActionDesired limit200, limit500;
  limit200.setMaxVel(200);
  limit500.setMaxVel(500);
  limit500.setMaxNegVel(-50);
  FixedAction low("low", limit200), high("high", limit500), go("go", vel(900));
  list.add(high, 9);
  list.add(low, 1);
  list.add(go, 5);
  EXPECT_EQ(list.resolve(pioneer).getMaxVel(), 200);
  EXPECT_EQ(list.resolve(pioneer).getMaxNegVel(), -50);
}

TEST_F(Actions, TurnToAHeadingByTheSmallerAngle) {
  ActionDesired desired;
  desired.setHeading(-170);
  FixedAction turn("turn", desired);
  list.add(turn, 1);
  pioneer.moveTo({.x = 0, .y = 0, .th = 170});
  EXPECT_NEAR(list.resolve(pioneer).getDeltaHeading(), 20, 1e-9);
}

TEST_F(Actions, AreIgnoredWhileTheyAreNotActive) {
  FixedAction high("high", vel(300)), low("low", vel(100));
  pioneer.addAction(high, 9);
  EXPECT_EQ(high.getRobot(), &pioneer);
  list.add(high, 9);
  list.add(low, 1);
  high.deactivate();
  EXPECT_FALSE(high.isActive());
  EXPECT_EQ(list.resolve(pioneer).getVel(), 100);
  list.deactivateAll();
  EXPECT_EQ(list.resolve(pioneer).getVelStrength(), ActionDesired::NO_STRENGTH);
  high.activate();
  EXPECT_EQ(list.resolve(pioneer).getVel(), 300);
}

TEST_F(Actions, ChangeAccelerationsForAStep) {
  ActionDesired gentle, hard;
  gentle.setTransAccel(100);
  gentle.setTransDecel(300);
  gentle.setMaxRotVel(30);
  hard.setTransAccel(400);
  hard.setTransDecel(800);
  hard.setMaxRotVel(10);
  hard.setRotVel(90);
  hard.setVel(900);
  FixedAction a("a", gentle), b("b", hard);
  list.add(a, 2);
  list.add(b, 1);
  const ActionDesired settled = list.resolve(pioneer);
  EXPECT_EQ(settled.getTransAccel(), 100);
  EXPECT_EQ(settled.getTransDecel(), 800);
  EXPECT_EQ(settled.getMaxRotVel(), 10);
  EXPECT_EQ(settled.getMaxRotVelStrength(), ActionDesired::MAX_STRENGTH);
  EXPECT_EQ(settled.getMaxVelStrength(), ActionDesired::NO_STRENGTH);
  EXPECT_FALSE(settled.getRotAccel());

  pioneer.addAction(a, 2);
  pioneer.addAction(b, 1);
  const auto steps = [&](int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      pioneer.update();
    }
  };
  steps(11);  // commanded in the step before it drives
  EXPECT_NEAR(pioneer.getVel(), 100, 1e-6);
  EXPECT_NEAR(pioneer.getRotVel(), 10, 1e-6);
  EXPECT_EQ(pioneer.getTransAccel(), 500);  // the robot's own
  pioneer.remAction(a);
  steps(6);  // one more at 100 mm/s², then five at 400 mm/s²
  EXPECT_NEAR(pioneer.getVel(), 310, 1e-6);
}

TEST_F(Actions, AverageDesiresOnceTheirStrengthsSumToOne) {
  // A plain computation: the priorities' means, each weighted by the strength that those before leave.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-500, 500), strength(0, 1);
  for (int round = 0; round < 500; ++round) {
    std::vector<FixedAction> actions;
    ActionList several;
    double left = 1, sum = 0;
    for (int priority = 5; priority > 0; --priority) {
      const double v = value(random), s = strength(random);
      actions.emplace_back("action", vel(v, s));
      sum += v * std::min(s, left);
      left -= std::min(s, left);
    }
    for (int i = 0; i < 5; ++i) several.add(actions[static_cast<std::size_t>(i)], 5 - i);
    const ActionDesired settled = several.resolve(pioneer);
    EXPECT_NEAR(settled.getVelStrength(), 1 - left, 1e-12);
    EXPECT_NEAR(settled.getVel(), sum / (1 - left), 1e-9);
  }
}

TEST_F(Actions, DriveTheRobotUntilDirectMotion) {
  FixedAction go("go", vel(300));
  pioneer.addAction(go, 10);
  const auto steps = [&](int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      pioneer.update();
    }
  };
  steps(20);
  EXPECT_NEAR(pioneer.getVel(), 300, 1e-6);
  pioneer.setVel(100);
  EXPECT_TRUE(pioneer.isDirectMotion());
  steps(20);
  EXPECT_NEAR(pioneer.getVel(), 100, 1e-6);
  pioneer.clearDirectMotion();
  steps(20);
  EXPECT_NEAR(pioneer.getVel(), 300, 1e-6);
  EXPECT_EQ(pioneer.findAction("go"), &go);
  EXPECT_EQ(pioneer.findAction("come"), nullptr);
}

TEST_F(Actions, WithoutDesiredMotionLetTheRobotStand) {
  FixedAction go("go", vel(300)), nothing("nothing", {});
  pioneer.addAction(go, 10);
  pioneer.addAction(nothing, 20);
  const auto steps = [&](int n) {
    for (int i = 0; i < n; ++i) {
      hardware.advance();
      pioneer.update();
    }
  };
  steps(20);
  pioneer.remAction(go);
  steps(20);
  EXPECT_EQ(pioneer.getVel(), 0);
}

}  // namespace
}  // namespace robosim
