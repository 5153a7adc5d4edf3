#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

#include "hardware/command.h"
#include "hardware/robot_info.h"
#include "remote/orders.h"

namespace robosim {

/// Converts a driver's orders into the robot's command for each step. Time is a parameter.
///
/// ACCELERATE and DECELERATE change the speed by a tenth of the robot's maximum, and reach 0 exactly; negative speeds
/// are backwards. TURN_LEFT and TURN_RIGHT turn at half of the maximum for kTurnTime, extended by each repetition.
/// DRIVE sets speed, turn and lateral speed, clamped to the robot's maximum. The robot's limits on acceleration always
/// apply.
///
/// Dead-man timeout: the robot stops when its driver has sent no message for longer than `dead_man`; whyStopped()
/// returns the reason. It stands until it is steered again; ALIVE does not restart it.
///
/// STOP, the dead-man timeout and release() stop the robot by Command::emergency_stop until endStop(): orders before
/// that take effect then, as after ESTOP of ARCOS.
class DriveCommandFilter {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kTurnTime{300};
  static constexpr std::chrono::milliseconds kDeadMan{500};  ///< default

  explicit DriveCommandFilter(const MotionLimits& limits, Clock::duration dead_man = kDeadMan)
      : limits_(limits), dead_man_(dead_man) {}

  /// A driver takes over: the robot stands until it is steered.
  void begin(Clock::time_point now);
  /// Records a message of the driver, for the dead-man timeout.
  void noteMessage(Clock::time_point when) { last_message_ = std::max(last_message_, when); }
  /// Applies an order. Orders that do not steer only reset the dead-man timeout.
  /// @param when time at which the order was received
  void obey(const v1::ControlRequest& order, Clock::time_point when);
  /// Stops the robot because the driver has left, with the reason.
  void release(const std::string& why);

  /// The command for the next step.
  /// @param driver name, for the reason of a stop
  Command command(Clock::time_point now, const std::string& driver);
  /// Reason why the last order is not executed; empty when it is.
  const std::string& whyStopped() const { return why_stopped_; }
  /// Whether an emergency stop is being made.
  bool isStopping() const { return is_stopping_; }
  /// The robot stands, or no longer executes the driver's orders.
  void endStop() { is_stopping_ = false; }
  /// Number of stops with a reason. A remote control that sees only the newest state detects a stop by it, although a
  /// later order has already cleared whyStopped().
  std::uint32_t stops() const { return stops_; }

 private:
  void steer(const OrderRow& row, Clock::time_point when);
  void set(const v1::ControlRequest::Drive& drive);
  void stop(const std::string& why);
  void stand(const std::string& why);
  bool isDriving() const { return speed_mps_ != 0 || turn_radps_ != 0 || lateral_mps_ != 0; }

  MotionLimits limits_;
  Clock::duration dead_man_;
  Clock::time_point last_message_, turn_ends_;
  bool turn_is_short_ = false;  ///< the turn ends at turn_ends_
  double speed_mps_ = 0, turn_radps_ = 0, lateral_mps_ = 0;
  float laser_pan_rad_ = 0;
  bool is_stopping_ = false;
  std::string why_stopped_;
  std::uint32_t stops_ = 0;
};

}  // namespace robosim
