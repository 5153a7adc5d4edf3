#pragma once
#include "control/robot.h"

namespace robosim {

/// Limits of speed and acceleration of one axis: translation [m] or rotation [rad].
struct AxisLimits {
  double speed_max = 0;
  double accel = 0;  ///< speeding up
  double decel = 0;  ///< slowing down
};

/// The speed for the next `period_s`: as near to `desired` as the limits allow from the present `speed`.
double speedTowards(double desired, double speed, const AxisLimits&, double period_s);

/// The highest speed (signed) for the next `period_s` from which the axis can still stop after `to_go`, when it
/// decelerates by `decel` > 0 once per period.
double speedToStopAfter(double to_go, double decel, double period_s);

/// Trapezoidal velocity profile, as in the firmware of the Pioneer and the Nomad: for a speed or a distance, the robot
/// accelerates, cruises and decelerates within its limits, measuring its motion by odometry. Translation and rotation
/// are independent axes.
///
/// Each command takes effect in the next time step; update() continues it once per step.
class ProfiledDrive {
 public:
  /// @throws std::invalid_argument for a robot without odometry.
  explicit ProfiledDrive(Robot& robot);

  void setSpeed(double speed_mps);
  void moveBy(double way_m);  ///< negative: backwards
  void setTurn(double turn_radps);
  /// Without a profile; without effect on a robot whose drive is not omnidirectional.
  void setLateral(double lateral_mps);
  void turnBy(double angle_rad);  ///< counter-clockwise; may be more than a full turn
  void turnTo(double odom_rad);   ///< by the smaller angle to a heading in the odometry frame
  void stop();                    ///< decelerates to rest
  /// While disabled, the robot stands and ignores commands.
  void enable(bool on);
  bool enabled() const { return enabled_; }

  /// Remaining distance [m] and angle [rad], signed; 0 for an axis in speed control.
  double wayToGo() const { return way_.toGo(); }
  double turnToGo() const { return turn_.toGo(); }
  /// The speeds commanded for this step.
  double speed() const { return robot_.command().speed_mps; }
  double turnSpeed() const { return robot_.command().turn_radps; }

  const AxisLimits& wayLimits() const { return way_.limits; }
  const AxisLimits& turnLimits() const { return turn_.limits; }
  /// Sets the limits. Values that are not positive or exceed the hardware's limits are replaced by the latter.
  void limitWay(const AxisLimits& limits);
  void limitTurn(const AxisLimits& limits);

  /// Reads the odometry of the last step, and commands the next. Idempotent within a step.
  void update();

 private:
  struct Axis {
    AxisLimits limits;
    bool to_target = false;  ///< position control towards `target`; otherwise speed control
    double speed = 0;
    double target = 0;   ///< on the scale of `covered`
    double covered = 0;  ///< since the start, signed

    void keep(double new_speed);
    void go(double distance);
    double toGo() const { return to_target ? target - covered : 0; }
    double next(double speed_now, double period_s) const;
  };
  void command();

  Robot& robot_;
  Axis way_, turn_;
  double lateral_mps_ = 0;
  mrpt::math::TPose2D last_odom_from_robot_;
  bool enabled_ = true;
};

}  // namespace robosim
