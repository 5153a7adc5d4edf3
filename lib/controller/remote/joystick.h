#pragma once
#include <optional>
#include <vector>

namespace robosim {

/// State of a joystick or gamepad.
struct StickState {
  double x = 0;               ///< to the right, [-1, 1]
  double y = 0;               ///< towards the person, [-1, 1]
  std::vector<bool> buttons;  ///< pressed; index 0 is button 1
};

/// A joystick or gamepad; openJoystick() (devices/devices.h) opens one of this computer.
class Joystick {
 public:
  virtual ~Joystick() = default;
  /// nullopt while there is no readable joystick.
  virtual std::optional<StickState> read() = 0;
};

}  // namespace robosim
