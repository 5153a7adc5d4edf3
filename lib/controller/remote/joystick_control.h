#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "remote/joystick_driver.h"
#include "remote/robot_news.h"

namespace robosim {

/// Drives a robot by a joystick: a JoystickDriver, which also latches
/// - after a stop of the robot for a reason of its own (v1::RobotState::stops), after which the robot is stopped
///   once more, because an order that was still on its way may have moved it again,
/// - while the robot cannot be driven: it is disconnected, or has another driver,
/// - while the robot does not report: kLost without an update. The robot is then stopped.
/// Time is a parameter.
class JoystickControl {
 public:
  using Clock = JoystickDriver::Clock;
  static constexpr std::chrono::seconds kLost{2};

  struct Output {
    std::vector<v1::ControlRequest> orders{};  ///< to send now, in this sequence
    bool switches = false;                     ///< the next robot is requested
  };

  /// @param top_speed fraction of the robot's maximum, (0, 1]
  explicit JoystickControl(double top_speed) : top_speed_(top_speed), driver_(top_speed) {}

  /// To be called about 20 times per second while there is a joystick.
  Output next(const RobotNews& robot, const StickState& stick, Clock::time_point now);
  /// To be called while there is no joystick.
  void loseStick() { driver_ = JoystickDriver(top_speed_); }
  /// Another robot is driven from now on.
  void switchRobot(Clock::time_point now);

 private:
  bool hasStopped(const RobotNews& robot);
  bool isLost(const RobotNews& robot, Clock::time_point now);

  double top_speed_;
  JoystickDriver driver_;
  std::optional<std::uint32_t> stops_;         ///< of the robot, at the last call; nullopt while it cannot be driven
  std::shared_ptr<const RobotUpdate> update_;  ///< the newest
  std::optional<Clock::time_point> updated_;   ///< time at which it was received
  bool was_lost_ = false;
};

}  // namespace robosim
