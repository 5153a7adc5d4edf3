#pragma once
#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include "hardware/robot_info.h"
#include "remote/joystick.h"
#include "remote/orders.h"

namespace robosim {

/// Converts a joystick's state to orders. The stick sets speed and turn; of the buttons, counted from 1 as in 2005, 1
/// switches to the next robot, 2 requests CheckWin, 3 accelerates and 4 decelerates; every other button stops the
/// robot. Time is a parameter. The console's page follows the same rules (page/motion.js, page/gamepad.js).
///
/// A stop latches, as does latch(); motion is also latched initially: no order moves the robot until the stick is in
/// its dead zone and all buttons from 3 on are released, all at the same time.
///
/// A robot that cruises (a speed set by buttons 3 and 4, stick centred) is stopped kPresence after the last input.
///
/// The top speed applies to the stick and to button 3 and 4: no order sets a higher speed.
class JoystickDriver {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kDeadZone = 0.12;                 ///< fraction of the stick's range
  static constexpr std::chrono::milliseconds kRepeat{250};  ///< of buttons 3 and 4 while held
  static constexpr std::chrono::seconds kPresence{5};       ///< for which a robot cruises without an input
  /// After an order, within which the robot's reports may be older.
  static constexpr std::chrono::seconds kConfirm{1};

  /// @param top_speed fraction of the robot's maximum, (0, 1]
  explicit JoystickDriver(double top_speed = 1) : top_speed_(top_speed) {}

  struct Output {
    std::optional<v1::ControlRequest>
        order;  ///< to send now: steering, a stop, or ALIVE; nullopt while no driver is present
    bool checks_win = false;
    bool switches = false;
  };

  /// The robot's commanded speed as reported by it, a fraction of its maximum, for the top speed of buttons 3 and 4.
  /// Reports that may be older than the last order are ignored.
  void setCommanded(double part, Clock::time_point now);

  /// To be called about 20 times per second. Returns the stick's order each time, and its release once.
  Output convert(const StickState& state, const MotionLimits& limits, Clock::time_point now);

  /// Before another robot is driven, when the robot has stopped for a reason of its own, and while it cannot be driven.
  void latch();

  /// Fraction of the robot's maximum for a deflection: 0 in the dead zone, with a low gain near it.
  static double shaped(double deflection);

 private:
  bool isPressed(const StickState& state, std::size_t button, bool repeats, Clock::time_point now);

  bool mayChangeSpeed(int tenths, Clock::time_point now);
  bool stops(const StickState& state);
  bool isNeutral(double speed, double turn) const;

  double top_speed_;
  double commanded_ = 0;                                     ///< the robot's commanded speed, a fraction of its maximum
  std::optional<Clock::time_point> set_;                     ///< time of the last order that set it
  std::array<std::optional<Clock::time_point>, 5> pressed_;  ///< by button: time of its last order
  std::vector<bool> stop_pressed_;                           ///< by index among the buttons that stop
  bool steers_speed_ = false, steers_turn_ = false;
  bool is_neutral_ = false;  ///< at the last call
  bool is_latched_ = true;
  std::optional<Clock::time_point> input_;  ///< time of the last input; nullopt once the person is absent
};

}  // namespace robosim
