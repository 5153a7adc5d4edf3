#pragma once
#include <memory>
#include <optional>
#include <vector>

namespace robosim {

/// How a joystick or gamepad stands.
struct StickState {
  double x = 0;               ///< to the right, [-1, 1]
  double y = 0;               ///< towards the person, [-1, 1]
  std::vector<bool> buttons;  ///< pressed; the first is what people call button 1
};

/// A joystick of this machine (Linux: /dev/input/jsN), by mrpt::hwdrivers::CJoystick. It may be plugged in and out.
class Joystick {
 public:
  /// @param number of the joystick, 0 for the first
  explicit Joystick(int number);
  ~Joystick();

  /// nullopt while there is none, or none that this user may read.
  std::optional<StickState> read();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
