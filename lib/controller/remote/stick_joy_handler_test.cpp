#include "remote/stick_joy_handler.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

struct AbsentJoystick : Joystick {
  std::optional<StickState> read() override { return std::nullopt; }
};

TEST(StickJoyHandler, PointsAheadWhereTheStickPointsAwayFromThePerson) {
  const JoyState state = toJoyState({.x = 0.5, .y = -0.25, .buttons = {true, false}});
  EXPECT_EQ(state.x, 0.5);
  EXPECT_EQ(state.y, 0.25);
  EXPECT_EQ(state.buttons, (std::vector<bool>{true, false}));
}

TEST(StickJoyHandler, HasNoStateWithoutAJoystick) {
  StickJoyHandler joystick(std::make_unique<AbsentJoystick>());
  EXPECT_FALSE(joystick.haveJoystick());
  EXPECT_FALSE(joystick.getButton(1));
}

}  // namespace
}  // namespace robosim
