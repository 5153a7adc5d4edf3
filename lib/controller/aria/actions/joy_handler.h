#pragma once
#include <optional>
#include <vector>

namespace robosim {

/// State of a joystick.
struct JoyState {
  double x = 0;               ///< to the right, [-1, 1]
  double y = 0;               ///< ahead, [-1, 1]
  std::vector<bool> buttons;  ///< pressed; index 0 is button 1
};

/// A joystick for actions, in the place of ARIA's ArJoyHandler. remote/joystick.h has one for the joysticks of the
/// machine; `control` itself reads no devices but the terminal.
class JoyHandler {
 public:
  virtual ~JoyHandler() = default;
  /// nullopt while there is no joystick.
  virtual std::optional<JoyState> read() = 0;

  bool haveJoystick() { return read().has_value(); }
  /// @param number from 1
  bool getButton(int number) {
    const auto state = read();
    return state && number >= 1 && static_cast<std::size_t>(number) <= state->buttons.size() &&
           state->buttons[static_cast<std::size_t>(number) - 1];
  }
};

/// Whether one of the buttons 1 and 2 is pressed, which releases the motion.
inline bool isReleased(const JoyState& state) {
  const auto pressed = [&](std::size_t i) { return i < state.buttons.size() && state.buttons[i]; };
  return pressed(0) || pressed(1);
}

}  // namespace robosim
