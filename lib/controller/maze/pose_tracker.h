#pragma once
#include <optional>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "control/robot.h"
#include "maze/pose_filter.h"
#include "maze/scan_matcher.h"

namespace robosim {

/// Pose of a robot relative to its start, by wheel odometry, with heading drift corrected by a compass if it has one
/// (complementary filter), or for noisy robots by a PoseFilter. Frame `start`: the robot's pose at the first update is
/// (0, 0, 0).
class PoseTracker {
 public:
  /// @param map_from_start pose in the map at the first update, for another frame than `start`
  /// @param is_noisy whether a PoseFilter is used
  explicit PoseTracker(const mrpt::math::TPose2D& map_from_start = {}, bool is_noisy = false)
      : start_from_robot_(map_from_start) {
    if (is_noisy) filter_.emplace(map_from_start);
  }

  /// Adds the odometry's motion since the last update; called once per time step.
  const mrpt::math::TPose2D& update(const Robot& robot);
  const mrpt::math::TPose2D& startFromRobot() const { return start_from_robot_; }
  /// Corrects the pose by surfaces in the robot frame. Requires a noisy robot.
  void match(const std::vector<SurfacePoint>& surfaces, ScanMatcher& matcher) {
    matcher.match(surfaces, *filter_);
    start_from_robot_ = filter_->startFromRobot();
  }

 private:
  mrpt::math::TPose2D start_from_robot_;
  std::optional<mrpt::math::TPose2D> last_odom_from_robot_;
  double compass_at_start_rad_ = 0;
  std::optional<PoseFilter> filter_;
};

}  // namespace robosim
