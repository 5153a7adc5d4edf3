#pragma once
#include "control/robot.h"

namespace robosim {

/// How fast something may go, and change how it goes: along the way [m] or in turning [rad].
struct AxisLimits {
  double speed_max = 0;
  double accel = 0;  ///< speeding up
  double decel = 0;  ///< slowing down
};

/// The speed for the next `period_s`, as near to `wish` as the limits allow for something that now goes at `speed`.
double speedTowards(double wish, double speed, const AxisLimits&, double period_s);

/// The highest speed (signed) for the next `period_s` from which it can still come to rest with `to_go` covered, if it
/// slows down once a period, by `decel` > 0.
double speedToStopAfter(double to_go, double decel, double period_s);

/// Drives a robot as a Pioneer's or a Nomad's firmware does: told a speed or a distance, it speeds up, cruises and
/// slows down within its limits (a trapezoid of speed over time), measuring the way by odometry. The way and the turn
/// are two such axes, independent of each other.
///
/// Every order takes effect in the next time step; then update() goes on with it, once a step.
class ProfiledDrive {
 public:
  /// @throws std::invalid_argument for a robot without odometry.
  explicit ProfiledDrive(Robot& robot);

  void setSpeed(double speed_mps);
  void moveBy(double way_m);  ///< negative: backwards
  void setTurn(double turn_radps);
  void turnBy(double angle_rad);  ///< counter-clockwise; may be more than a full turn
  void turnTo(double odom_rad);   ///< the shorter way round to a heading of the odometry frame
  void stop();                    ///< slows down to rest
  /// Off: the robot stands, whatever it is told.
  void enable(bool on);
  bool enabled() const { return enabled_; }

  /// Way [m] and turn [rad] still to go, signed; 0 for an axis that has been told a speed.
  double wayToGo() const { return way_.toGo(); }
  double turnToGo() const { return turn_.toGo(); }
  /// The speeds that the robot has been told for this step.
  double speed() const { return robot_.command().speed_mps; }
  double turnSpeed() const { return robot_.command().turn_radps; }

  const AxisLimits& wayLimits() const { return way_.limits; }
  const AxisLimits& turnLimits() const { return turn_.limits; }
  /// Never above what the robot's hardware can do: higher values, and such as are not positive, are taken as that.
  void limitWay(const AxisLimits& limits);
  void limitTurn(const AxisLimits& limits);

  /// Takes over what the odometry says of the last step, and commands the next. More than once a step does no harm.
  void update();

 private:
  struct Axis {
    AxisLimits limits;
    bool to_target = false;  ///< go to `target`; otherwise keep `speed`
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
  mrpt::math::TPose2D last_odom_from_robot_;
  bool enabled_ = true;
};

}  // namespace robosim
