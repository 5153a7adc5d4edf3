#pragma once
#include <memory>
#include <optional>
#include <utility>

#include "aria/actions/joy_handler.h"
#include "remote/joystick.h"

namespace robosim {

/// Converts the state of a joystick, whose y points towards the person, to that for actions.
inline JoyState toJoyState(const StickState& stick) { return {.x = stick.x, .y = -stick.y, .buttons = stick.buttons}; }

/// A joystick for ActionJoydrive and RatioInputJoydrive.
class StickJoyHandler : public JoyHandler {
 public:
  /// @param stick not null; openJoystick() (devices/devices.h) opens one of this computer
  explicit StickJoyHandler(std::unique_ptr<Joystick> stick) : stick_(std::move(stick)) {}
  std::optional<JoyState> read() override {
    const auto state = stick_->read();
    return state ? std::optional(toJoyState(*state)) : std::nullopt;
  }

 private:
  std::unique_ptr<Joystick> stick_;
};

}  // namespace robosim
