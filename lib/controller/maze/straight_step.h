#pragma once
#include <optional>

#include "control/robot.h"

namespace robosim {

/// One step of a walk: a turn on the spot, then a straight drive, both measured by odometry.
class StraightStep {
 public:
  /// @param turn_rad counter-clockwise, [-π, π] @param length_m > 0
  void begin(double turn_rad, double length_m) {
    turn_rad_ = turn_rad;
    length_m_ = length_m;
  }
  /// Ends the step.
  void drop() { turn_rad_ = length_m_ = 0; }

  /// Subtracts the motion since the last call; called once per time step, before drive().
  /// @return whether the step has ended: at its length, or in front of an obstacle
  bool hasEnded(const Robot& robot);
  /// Commands the robot; it brakes in front of obstacles.
  void drive(Robot& robot) const;

 private:
  double turn_rad_ = 0, length_m_ = 0;      ///< remaining
  std::optional<double> last_heading_rad_;  ///< odometry frame
};

/// Distance [m] to an obstacle in the lane ahead at which a step ends.
double stoppingGap(const Robot& robot);

}  // namespace robosim
