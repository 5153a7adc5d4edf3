#pragma once
#include <array>
#include <chrono>
#include <optional>

#include "hardware/robot_info.h"
#include "net/remote_wire.h"
#include "remote/joystick.h"

namespace robosim {

/// What a person does with a joystick, made into orders: the handle steers, to the sides as in 2005 and to and fro as
/// one expects today; of the buttons, counted from 1 as in 2005, 2 asks whether the robot has won, 3 accelerates, 4
/// decelerates, and 1 switches to the next robot. Time is handed in. The console's page does the same (page/drive.js).
class StickPilot {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kDeadZone = 0.12;                 ///< of the handle's reach
  static constexpr std::chrono::milliseconds kRepeat{250};  ///< of buttons 3 and 4 while they are held

  struct Wish {
    RemoteOrder order;  ///< to say now: to steer, or that the driver is there
    bool checks_win = false;
    bool switches = false;
  };

  /// Some 20 times a second. What the handle steers is said each time, and once that it has been let go of.
  Wish wish(const StickState& state, const MotionLimits& limits, Clock::time_point now);

  /// What of the robot's most a deflection asks for: nothing in the dead zone, little near it.
  static double shaped(double deflection);

 private:
  bool isPressed(const StickState& state, std::size_t button, bool repeats, Clock::time_point now);

  std::array<std::optional<Clock::time_point>, 5> pressed_;  ///< by button: when it counted last
  bool steers_speed_ = false, steers_turn_ = false;
};

}  // namespace robosim
