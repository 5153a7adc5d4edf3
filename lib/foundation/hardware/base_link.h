#pragma once
#include <optional>
#include <string>

namespace robosim {

/// State of a mobile base that no sensor measures. Each value is absent where the base does not report it. Battery
/// voltage, compass, bumpers and odometry are measurements of sensors (SensorKind) instead.
struct BaseState {
  std::optional<bool> motors_enabled = {};
  std::optional<bool> estop_pressed = {};
  std::optional<bool> left_stalled = {};  ///< by wheel; Readings::stalled is for the body as a whole
  std::optional<bool> right_stalled = {};
  std::optional<double> charge_percent = {};  ///< state of charge of the battery, [0, 100]
  std::string stop_reason = {};  ///< why the robot stands whatever is commanded, "the battery is low"; empty if not
  bool operator==(const BaseState&) const = default;
};

/// Connection of a robot to the controller of its base. Real robots have one; simulated ones do not, because their
/// motors and sonars are always on.
class BaseLink {
 public:
  virtual ~BaseLink() = default;
  /// State at the end of the last time step; constant between two time steps, as the readings.
  virtual BaseState baseState() const = 0;
  /// Switch the motors and the sonars. Effective when `baseState()` and the readings show it.
  virtual void enableMotors(bool on) = 0;
  virtual void enableSonar(bool on) = 0;
};

}  // namespace robosim
