#include "maze/pose_tracker.h"

#include <mrpt/math/wrap2pi.h>

#include "base/portable_pose.h"

namespace robosim {
namespace {

/// Fraction of the difference between compass and heading that is corrected per step: a compass is noisy, but does not
/// drift.
constexpr double kCompassTrust = 0.02;

}  // namespace

const mrpt::math::TPose2D& PoseTracker::update(const Robot& robot) {
  const auto& odom_from_robot = robot.odometry().odom_from_robot;
  const auto compass_rad = robot.compass();
  if (!last_odom_from_robot_) {
    last_odom_from_robot_ = odom_from_robot;
    compass_at_start_rad_ = compass_rad.value_or(0) - start_from_robot_.phi;
  }
  if (filter_) {
    mrpt::math::TPose2D motion = portable::relative(*last_odom_from_robot_, odom_from_robot);
    if (robot.stalled()) motion.x = motion.y = 0;  // the wheels slip
    filter_->move(motion);
    if (compass_rad) filter_->turnTo(*compass_rad);
    last_odom_from_robot_ = odom_from_robot;
    return start_from_robot_ = filter_->startFromRobot();
  }
  start_from_robot_ = portable::compose(start_from_robot_, portable::relative(*last_odom_from_robot_, odom_from_robot));
  last_odom_from_robot_ = odom_from_robot;
  if (compass_rad) {
    const double heading = *compass_rad - compass_at_start_rad_;
    start_from_robot_.phi += kCompassTrust * mrpt::math::wrapToPi(heading - start_from_robot_.phi);
  }
  start_from_robot_.phi = mrpt::math::wrapToPi(start_from_robot_.phi);
  return start_from_robot_;
}

}  // namespace robosim
