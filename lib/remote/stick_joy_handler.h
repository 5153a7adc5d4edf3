#pragma once
#include <optional>

#include "control/actions/joy_handler.h"
#include "remote/joystick.h"

namespace robosim {

/// Converts the state of a joystick, whose y points towards the person, to that for actions.
inline JoyState joyStateOf(const StickState& stick) { return {.x = stick.x, .y = -stick.y, .buttons = stick.buttons}; }

/// A joystick of this machine for ActionJoydrive and RatioInputJoydrive.
class StickJoyHandler : public JoyHandler {
 public:
  /// @param number of the joystick, 0 for the first
  explicit StickJoyHandler(int number = 0) : stick_(number) {}
  std::optional<JoyState> read() override {
    const auto state = stick_.read();
    return state ? std::optional(joyStateOf(*state)) : std::nullopt;
  }

 private:
  Joystick stick_;
};

}  // namespace robosim
