#pragma once
#include <memory>
#include <optional>
#include <vector>

namespace robosim {

/// State of a joystick or gamepad.
struct StickState {
  double x = 0;               ///< to the right, [-1, 1]
  double y = 0;               ///< towards the person, [-1, 1]
  std::vector<bool> buttons;  ///< pressed; index 0 is button 1
};

/// A joystick of this machine (Linux: /dev/input/jsN), by mrpt::hwdrivers::CJoystick. Supports hot-plugging.
class Joystick {
 public:
  /// @param number of the joystick, 0 for the first
  explicit Joystick(int number);
  ~Joystick();

  /// nullopt while there is no readable joystick.
  std::optional<StickState> read();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
