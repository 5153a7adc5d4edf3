#include "maze/straight_step.h"

#include <algorithm>
#include <cmath>

#include <mrpt/math/wrap2pi.h>

#include "maze/path_driver.h"

namespace robosim {
namespace {

constexpr double kGap_radii = 0.3;
constexpr double kTurnDone_rad = 0.05;
constexpr double kTurnRate_per_s = 2.5;

}  // namespace

double stoppingGap(const Robot& robot) { return kGap_radii * robot.info().radius_m; }

bool StraightStep::hasEnded(const Robot& robot) {
  const Odometry& odometry = robot.odometry();
  const double heading_rad = odometry.odom_from_robot.phi;
  const double turned_rad = mrpt::math::wrapToPi(heading_rad - last_heading_rad_.value_or(heading_rad));
  last_heading_rad_ = heading_rad;
  if (turn_rad_ != 0) {
    const double rest_rad = turn_rad_ - turned_rad;
    const bool is_done = std::abs(rest_rad) < kTurnDone_rad || (rest_rad > 0) != (turn_rad_ > 0);
    turn_rad_ = is_done ? 0 : rest_rad;
    return false;
  }
  length_m_ -= std::abs(odometry.speed_mps) * robot.readings().time.period_s;
  return length_m_ <= 0 || robot.stalled() || clearanceInLane(robot, 1) < stoppingGap(robot);
}

void StraightStep::drive(Robot& robot) const {
  const MotionLimits& limits = robot.info().type->limits;
  if (turn_rad_ != 0) {
    robot.drive(0, std::clamp(kTurnRate_per_s * turn_rad_, -limits.turn_max_radps, limits.turn_max_radps));
    return;
  }
  const double clearance_m = std::max(0.0, clearanceInLane(robot, 1) - stoppingGap(robot) / 2);
  const double loss_mps = limits.decel_mps2 * robot.readings().time.period_s;  // it brakes one step late
  const double braking_mps = std::sqrt(loss_mps * loss_mps + 2 * limits.decel_mps2 * clearance_m) - loss_mps;
  robot.drive(std::min(limits.speed_max_mps, braking_mps), 0);
}

}  // namespace robosim
