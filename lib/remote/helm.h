#pragma once
#include <algorithm>
#include <chrono>
#include <string>

#include "hardware/command.h"
#include "hardware/robot_info.h"
#include "net/remote_wire.h"

namespace robosim {

/// Where a driver steers a robot: makes of orders what the robot is commanded in each step. Time is handed in.
///
/// ACCELERATE and DECELERATE change the speed by a tenth of the robot's most, and so meet 0 exactly; below 0 it drives
/// backwards. TURN_LEFT and TURN_RIGHT turn it at half of its most for kTurnTime: as long as they keep coming. DRIVE
/// sets speed and turn, within the robot's most. Whatever is commanded, the robot's limits on acceleration apply.
///
/// Dead man's handle: a robot whose driver has said nothing for longer than `dead_man` stops, and whyStopped() tells.
/// It stands until the driver steers it again; word that the driver is alive does not set it going.
class Helm {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kTurnTime{300};
  static constexpr std::chrono::milliseconds kDeadMan{500};  ///< unless told otherwise

  explicit Helm(const MotionLimits& limits, Clock::duration dead_man = kDeadMan)
      : limits_(limits), dead_man_(dead_man) {}

  /// A driver takes over: the robot stands until it is steered.
  void begin(Clock::time_point now);
  /// The driver is there.
  void hear(Clock::time_point when) { last_heard_ = std::max(last_heard_, when); }
  /// Steers. Orders that are about something else count as a sign of life.
  /// @param when the order came
  void obey(const RemoteOrder& order, Clock::time_point when);
  /// The driver has gone, and why: the robot stops now.
  void release(const std::string& why);

  /// What the robot is to do in the coming step.
  /// @param driver who is to be named when nothing was heard of them
  Command command(Clock::time_point now, const std::string& driver);
  /// Why it does not do what it was told last; empty when it does.
  const std::string& whyStopped() const { return why_stopped_; }

 private:
  void stop(const std::string& why);

  MotionLimits limits_;
  Clock::duration dead_man_;
  Clock::time_point last_heard_, turn_ends_;
  bool turn_is_short_ = false;  ///< it ends at turn_ends_
  double speed_mps_ = 0, turn_radps_ = 0;
  float laser_pan_rad_ = 0;
  std::string why_stopped_;
};

}  // namespace robosim
