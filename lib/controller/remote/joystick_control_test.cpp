#include "remote/joystick_control.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// A robot that reports in every call, unless a test prevents it. Time advances by 50 ms per call.
class JoystickControlTest : public testing::Test {
 protected:
  JoystickControlTest() {
    RobotInfo info;
    info.type.edit().limits.speed_max_mps = 2;
    robot_.info = std::make_shared<const RobotInfo>(info);
    robot_.is_up = true;
    robot_.state.set_is_yours(true);
    next(0);  // not latched
  }

  /// The orders for a deflection of the stick away from the person, as text: "drive 2, stop: why".
  std::string next(double deflection, std::vector<bool> buttons = {}) {
    now_ += 50ms;
    if (reports_) robot_.update = std::make_shared<const RobotUpdate>();
    std::string text;
    for (const auto& order : control_.next(robot_, {0, -deflection, std::move(buttons)}, now_).orders) {
      if (!text.empty()) text += ", ";
      if (order.has_drive()) text += "drive " + std::to_string(std::lround(order.drive().speed_mps()));
      if (order.has_stop()) text += "stop: " + order.stop().why();
      if (order.has_alive()) text += "alive";
      if (order.has_check_win()) text += "check_win";
    }
    return text;
  }

  /// The stick that is held has no effect until it has been centred.
  void expectLatched() {
    EXPECT_EQ(next(1), "alive");
    EXPECT_EQ(next(1), "alive");
    EXPECT_EQ(next(0), "alive");
    EXPECT_EQ(next(1), "drive 2");
  }

  RobotNews robot_;
  bool reports_ = true;
  JoystickControl control_{1};
  JoystickControl::Clock::time_point now_{1h};
};

TEST_F(JoystickControlTest, DrivesWhileTheRobotReports) {
  for (int i = 0; i < 100; ++i) EXPECT_EQ(next(1), "drive 2");
  EXPECT_EQ(next(0), "drive 0");
  EXPECT_EQ(next(0, {false, true}), "alive, check_win");
}

TEST_F(JoystickControlTest, LatchesWhileTheRobotIsDisconnected) {
  EXPECT_EQ(next(1), "drive 2");
  robot_.is_up = false;
  for (int i = 0; i < 20; ++i) EXPECT_EQ(next(1), "");
  robot_.is_up = true;
  robot_.state.set_stops(0);
  expectLatched();
}

TEST_F(JoystickControlTest, LatchesWhileAnotherDriverHasTheRobot) {
  EXPECT_EQ(next(1), "drive 2");
  robot_.state.set_is_yours(false);
  EXPECT_EQ(next(1), "");
  EXPECT_EQ(next(0), "");
  EXPECT_EQ(next(1), "") << "released and deflected again meanwhile";
  robot_.state.set_is_yours(true);
  expectLatched();
}

TEST_F(JoystickControlTest, LatchesAfterAStopOfTheRobotWhoseReasonIsAlreadyLost) {
  EXPECT_EQ(next(1), "drive 2");
  robot_.state.set_stops(robot_.state.stops() + 1);  // a later order has cleared why_stopped, and moves the robot
  EXPECT_EQ(next(1), "stop: the joystick must be released after a stop");
  expectLatched();
}

TEST_F(JoystickControlTest, StopsAndLatchesARobotThatDoesNotReportForTwoSeconds) {
  EXPECT_EQ(next(1), "drive 2");
  reports_ = false;
  for (int i = 1; i < 40; ++i) EXPECT_EQ(next(1), "drive 2") << i;
  EXPECT_EQ(next(1), "stop: it has not reported to the joystick for 2 s");
  for (int i = 0; i < 10; ++i) EXPECT_EQ(next(i % 2), "") << "no order, whatever the stick";
  EXPECT_EQ(next(1), "");
  reports_ = true;
  expectLatched();
}

TEST_F(JoystickControlTest, AStopButtonStopsInEveryState) {
  const std::vector<bool> button{false, false, false, false, true};
  reports_ = false;
  for (int i = 1; i <= 41; ++i) next(0);
  EXPECT_EQ(next(0, button), "stop: ");
  next(0);
  robot_.state.set_is_yours(false);
  EXPECT_EQ(next(0, button), "stop: ");
}

TEST_F(JoystickControlTest, ASwitchLatchesAndComparesNothingWithTheFormerRobot) {
  EXPECT_EQ(next(1), "drive 2");
  control_.switchRobot(now_);
  robot_.state.set_stops(7);
  expectLatched();
}

TEST_F(JoystickControlTest, AJoystickThatIsConnectedAgainIsLatched) {
  EXPECT_EQ(next(1), "drive 2");
  control_.loseStick();
  expectLatched();
}

}  // namespace
}  // namespace robosim
