#pragma once
#include <optional>

#include <mrpt/math/TPose2D.h>

#include "control/robot.h"

namespace robosim {

/// Pose of a robot relative to its start, by wheel odometry, with heading drift corrected by a compass if it has one
/// (complementary filter). Frame `start`: the robot's pose at the first update is (0, 0, 0).
class PoseTracker {
 public:
  /// @param map_from_start pose in the map at the first update, for another frame than `start`
  explicit PoseTracker(const mrpt::math::TPose2D& map_from_start = {}) : start_from_robot_(map_from_start) {}

  /// Adds the odometry's motion since the last update; called once per time step.
  const mrpt::math::TPose2D& update(const Robot& robot);
  const mrpt::math::TPose2D& startFromRobot() const { return start_from_robot_; }

 private:
  mrpt::math::TPose2D start_from_robot_;
  std::optional<mrpt::math::TPose2D> last_odom_from_robot_;
  double compass_at_start_rad_ = 0;
};

}  // namespace robosim
