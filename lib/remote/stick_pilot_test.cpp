#include "remote/stick_pilot.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// At most 2 m/s and 1 rad/s. Each wish comes 50 ms after the one before.
class StickPilotTest : public testing::Test {
 protected:
  StickPilot::Wish wish(double x, double y, std::vector<bool> buttons = {}) {
    now_ += 50ms;
    return pilot_.wish({x, y, std::move(buttons)}, limits_, now_);
  }

 private:
  static MotionLimits robotLimits() {
    MotionLimits limits;
    limits.speed_max_mps = 2;
    limits.turn_max_radps = 1;
    return limits;
  }
  MotionLimits limits_ = robotLimits();
  StickPilot pilot_;
  StickPilot::Clock::time_point now_{1h};
};

TEST_F(StickPilotTest, TheHandlePushedAwayDrivesAndPushedLeftTurnsLeft) {
  const auto ahead = wish(0, -1).order;
  EXPECT_EQ(ahead.type, RemoteType::drive);
  EXPECT_EQ(ahead.speed_mps, 2);
  EXPECT_EQ(ahead.turn_radps, std::nullopt) << "the turn stays what it is";
  const auto left = wish(-1, 0).order;
  EXPECT_EQ(left.speed_mps, 0) << "the handle is back in the middle";
  EXPECT_EQ(left.turn_radps, 1);
}

TEST_F(StickPilotTest, AHandleThatWasLetGoStopsTheRobotOnceAndThenSaysThatItIsThere) {
  wish(1, 1);
  const auto stop = wish(0.1, -0.1).order;
  EXPECT_EQ(stop.type, RemoteType::drive);
  EXPECT_EQ(stop.speed_mps, 0);
  EXPECT_EQ(stop.turn_radps, 0);
  EXPECT_EQ(wish(0, 0).order.type, RemoteType::alive);
}

TEST_F(StickPilotTest, IsGentleOutsideTheDeadZone) {
  EXPECT_EQ(StickPilot::shaped(0.12), 0);
  EXPECT_NEAR(StickPilot::shaped(0.56), 0.35, 1e-12) << "half way: 0.4 / 2 + 0.6 / 4";
  EXPECT_NEAR(StickPilot::shaped(-0.56), -0.35, 1e-12);
  EXPECT_EQ(StickPilot::shaped(1), 1);
}

TEST_F(StickPilotTest, Buttons2To4AreThoseOf2005) {
  EXPECT_TRUE(wish(0, 0, {false, true, false, false}).checks_win);
  EXPECT_EQ(wish(0, 0, {false, false, true, false}).order.type, RemoteType::accelerate);
  EXPECT_EQ(wish(0, 0, {false, false, false, true}).order.type, RemoteType::decelerate);
  EXPECT_TRUE(wish(0, 0, {true}).switches);
}

TEST_F(StickPilotTest, AHeldButtonCountsOnceButThoseForTheSpeedFourTimesASecond) {
  int switches = 0;
  int accelerates = 0;
  for (int i = 0; i < 20; ++i) {  // a second
    const auto now = wish(0, 0, {true, false, true});
    switches += now.switches ? 1 : 0;
    accelerates += now.order.type == RemoteType::accelerate ? 1 : 0;
  }
  EXPECT_EQ(switches, 1);
  EXPECT_EQ(accelerates, 4);
}

TEST_F(StickPilotTest, AcceleratesAlsoWhileTheHandleTurns) {
  EXPECT_EQ(wish(-1, 0, {false, false, true}).order.type, RemoteType::accelerate);
  const auto next = wish(-1, 0, {false, false, true}).order;
  EXPECT_EQ(next.type, RemoteType::drive);
  EXPECT_EQ(next.turn_radps, 1);
  EXPECT_EQ(next.speed_mps, std::nullopt) << "it stays what button 3 made it";
}

}  // namespace
}  // namespace robosim
