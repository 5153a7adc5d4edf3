#include "remote/joystick_driver.h"

#include <random>

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// A robot with maximum speeds of 2 m/s and 1 rad/s. Time advances by 50 ms per call.
class JoystickDriverTest : public testing::Test {
 protected:
  JoystickDriverTest() { convert(0, 0); }  // not latched

  JoystickDriver::Output convert(double x, double y, std::vector<bool> buttons = {}) {
    now_ += 50ms;
    return driver_.convert({x, y, std::move(buttons)}, limits_, now_);
  }

  JoystickDriver::Clock::time_point time() const { return now_; }

  JoystickDriver driver_;

 private:
  static MotionLimits robotLimits() {
    MotionLimits limits;
    limits.speed_max_mps = 2;
    limits.turn_max_radps = 1;
    return limits;
  }
  MotionLimits limits_ = robotLimits();
  JoystickDriver::Clock::time_point now_{1h};
};

TEST_F(JoystickDriverTest, TheStickPushedAwayDrivesAndPushedLeftTurnsLeft) {
  const auto ahead = *convert(0, -1).order;
  EXPECT_EQ(typeOf(ahead), OrderType::drive);
  EXPECT_EQ(ahead.drive().speed_mps(), 2);
  EXPECT_FALSE(ahead.drive().has_turn_radps()) << "the turn is unchanged";
  const auto left = *convert(-1, 0).order;
  EXPECT_EQ(left.drive().speed_mps(), 0) << "the stick is centred";
  EXPECT_EQ(left.drive().turn_radps(), 1);
}

TEST_F(JoystickDriverTest, ReleasingTheStickStopsTheRobotOnceThenSendsAlive) {
  convert(1, 1);
  const auto stop = *convert(0.1, -0.1).order;
  EXPECT_EQ(typeOf(stop), OrderType::drive);
  EXPECT_EQ(stop.drive().speed_mps(), 0);
  EXPECT_EQ(stop.drive().turn_radps(), 0);
  EXPECT_EQ(typeOf(*convert(0, 0).order), OrderType::alive);
}

TEST_F(JoystickDriverTest, HasALowGainOutsideTheDeadZone) {
  EXPECT_EQ(JoystickDriver::shaped(0.12), 0);
  EXPECT_NEAR(JoystickDriver::shaped(0.56), 0.35, 1e-12) << "half way: 0.4 / 2 + 0.6 / 4";
  EXPECT_NEAR(JoystickDriver::shaped(-0.56), -0.35, 1e-12);
  EXPECT_EQ(JoystickDriver::shaped(1), 1);
}

TEST_F(JoystickDriverTest, Buttons2To4AreThoseOf2005) {
  EXPECT_TRUE(convert(0, 0, {false, true, false, false}).checks_win);
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, true, false}).order), OrderType::accelerate);
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, false, true}).order), OrderType::decelerate);
  EXPECT_TRUE(convert(0, 0, {true}).switches);
}

TEST_F(JoystickDriverTest, AHeldButtonCausesOneOrderAndSpeedButtonsRepeatFourTimesPerSecond) {
  int switches = 0;
  int accelerates = 0;
  for (int i = 0; i < 20; ++i) {  // a second
    const auto now = convert(0, 0, {true, false, true});
    switches += now.switches ? 1 : 0;
    accelerates += now.order && typeOf(*now.order) == OrderType::accelerate ? 1 : 0;
  }
  EXPECT_EQ(switches, 1);
  EXPECT_EQ(accelerates, 4);
}

TEST_F(JoystickDriverTest, DoesNotMoveAnotherRobotBeforeStickAndButtonsAreReleased) {
  EXPECT_EQ(typeOf(*convert(0, -1).order), OrderType::drive);
  driver_.latch();
  EXPECT_EQ(typeOf(*convert(0, -1).order), OrderType::alive);
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, true}).order), OrderType::alive) << "button 3 is pressed";
  EXPECT_EQ(typeOf(*convert(0, 0).order), OrderType::alive);
  EXPECT_EQ(convert(0, -1).order->drive().speed_mps(), 2);
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, true}).order), OrderType::accelerate);
}

TEST_F(JoystickDriverTest, MovesAnotherRobotAtOnceWhenAllInputsWereNeutral) {
  driver_.latch();
  EXPECT_EQ(convert(0, -1).order->drive().speed_mps(), 2);
}

TEST_F(JoystickDriverTest, EveryButtonFromTheFifthOnStopsAndLatchesUntilAllInputsWereNeutral) {
  for (std::size_t button = 5; button <= 12; ++button) {
    SCOPED_TRACE(button);
    EXPECT_EQ(typeOf(*convert(0, -1).order), OrderType::drive);
    std::vector<bool> buttons(12, false);
    buttons[button - 1] = true;
    EXPECT_EQ(typeOf(*convert(0, -1, buttons).order), OrderType::stop);
    EXPECT_EQ(typeOf(*convert(0, -1, buttons).order), OrderType::alive) << "one stop for each press";
    EXPECT_EQ(typeOf(*convert(0, -1).order), OrderType::alive) << "the stick is deflected";
    EXPECT_EQ(typeOf(*convert(0, 0, buttons).order), OrderType::stop);
    buttons[2] = true;
    EXPECT_EQ(typeOf(*convert(0, 0, buttons).order), OrderType::alive) << "a button that accelerates is held";
    EXPECT_EQ(typeOf(*convert(0, 0).order), OrderType::alive);
  }
}

TEST_F(JoystickDriverTest, StopsACruisingRobotFiveSecondsAfterTheLastInput) {
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, true}).order), OrderType::accelerate);
  for (int i = 1; i < 100; ++i) EXPECT_EQ(typeOf(*convert(0, 0).order), OrderType::alive) << i;
  const auto stop = *convert(0, 0).order;
  EXPECT_EQ(typeOf(stop), OrderType::stop);
  EXPECT_EQ(stop.stop().why(), "received no joystick input for 5 s");
  EXPECT_EQ(convert(0, 0).order, std::nullopt) << "no driver is present";
  EXPECT_EQ(typeOf(*convert(0, -1).order), OrderType::drive);
}

TEST_F(JoystickDriverTest, NoMotionFollowsAStopInRandomSequencesBeforeAllInputsWereNeutral) {
  std::mt19937 random(19);
  const auto below = [&](unsigned bound) { return random() % bound; };
  std::vector<bool> buttons(6, false);
  double x = 0, y = 0;
  bool is_latched = false;
  int motions = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    switch (below(6)) {
      case 0:
        buttons[below(6)].flip();
        break;
      case 1:
        x = below(3) - 1.0;
        break;
      case 2:
        y = below(3) - 1.0;
        break;
      case 3:
        x = y = 0;
        buttons.assign(6, false);
        break;
      default:
        break;
    }
    const auto order = convert(x, y, buttons).order;
    if (x == 0 && y == 0 && buttons == std::vector<bool>{buttons[0], buttons[1], false, false, false, false}) {
      is_latched = false;
    }
    const bool is_motion = order && (order->has_drive() || order->has_steer());
    ASSERT_FALSE(is_latched && is_motion) << "event " << i;
    if (order && order->has_stop()) is_latched = true;
    motions += is_motion ? 1 : 0;
  }
  EXPECT_GT(motions, 100'000);
}

TEST_F(JoystickDriverTest, TheTopSpeedAppliesToTheStickAndToButtons3And4) {
  driver_ = JoystickDriver(0.25);
  convert(0, 0);
  EXPECT_DOUBLE_EQ(convert(0, -1).order->drive().speed_mps(), 0.5) << "a quarter of 2 m/s";
  EXPECT_DOUBLE_EQ(convert(0, 1).order->drive().speed_mps(), -0.5);
  EXPECT_DOUBLE_EQ(convert(-1, 0).order->drive().turn_radps(), 1) << "turns are not limited";
  convert(0, 0);
  const std::vector<bool> accelerate{false, false, true};
  const std::vector<bool> decelerate{false, false, false, true};
  for (const auto& button : {accelerate, decelerate}) {
    for (int tenths = 1; tenths <= 2; ++tenths) {
      EXPECT_NE(typeOf(*convert(0, 0, button).order), OrderType::alive) << tenths;
      convert(0, 0);
    }
    EXPECT_EQ(typeOf(*convert(0, 0, button).order), OrderType::alive) << "3 tenths are more than a quarter";
    driver_.latch();
    convert(0, 0);
  }
}

TEST_F(JoystickDriverTest, TheTopSpeedAppliesToTheSpeedThatTheRobotReports) {
  driver_ = JoystickDriver(0.5);
  convert(0, 0);
  driver_.setCommanded(0.46, time());
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, true}).order), OrderType::alive)
      << "the robot rounds to 5 tenths, and would drive at 6";
  convert(0, 0);
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, false, true}).order), OrderType::decelerate);
  driver_.setCommanded(0, time());
  convert(0, 0);
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, true}).order), OrderType::accelerate);
  convert(0, 0);
  EXPECT_EQ(typeOf(*convert(0, 0, {false, false, true}).order), OrderType::alive)
      << "the report may be older than the orders, which set 4 and 5 tenths";
}

TEST_F(JoystickDriverTest, IsLatchedInitially) {
  driver_ = JoystickDriver();
  EXPECT_EQ(typeOf(*convert(-1, 0).order), OrderType::alive) << "deflected initially";
}

TEST_F(JoystickDriverTest, AcceleratesWhileTheStickTurns) {
  EXPECT_EQ(typeOf(*convert(-1, 0, {false, false, true}).order), OrderType::accelerate);
  const auto next = *convert(-1, 0, {false, false, true}).order;
  EXPECT_EQ(typeOf(next), OrderType::drive);
  EXPECT_EQ(next.drive().turn_radps(), 1);
  EXPECT_FALSE(next.drive().has_speed_mps()) << "unchanged after button 3";
}

}  // namespace
}  // namespace robosim
