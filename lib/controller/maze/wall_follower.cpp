#include "maze/wall_follower.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "control/echo.h"

namespace robosim {
namespace {

/// The nearest echo between two bearings [rad], from the robot's edge.
struct Nearest {
  double clearance_m = 1e9;
  double bearing_rad = 0;
};

Nearest nearestBetween(const Robot& robot, double from_rad, double to_rad) {
  Nearest nearest;
  const SensorInfo* sonar = robot.sensor(SensorKind::sonar);
  if (!sonar) return nearest;
  for (const Echo& echo : robot.sonar()) {
    if (!isEcho(*sonar, echo)) continue;
    const double bearing = portable::atan2(echo.point_m.y, echo.point_m.x);
    const double clearance_m = portable::hypot(echo.point_m.x, echo.point_m.y) - robot.info().radius_m;
    if (from_rad <= bearing && bearing <= to_rad && clearance_m < nearest.clearance_m) nearest = {clearance_m, bearing};
  }
  return nearest;
}

constexpr double kTurnFraction = 0.6;               // fraction of the maximum turn rate, before an obstacle
constexpr double kTouchTurn_rad = 60 * kRadPerDeg;  // away from a contact
constexpr double kTouchAhead_s = 1;

}  // namespace

void WallFollower::step(Robot& robot) {
  if (recovery_.takesOver(robot)) return;
  const MotionLimits& limits = robot.info().type->limits;
  const double radius = robot.info().radius_m;
  const double distance = options_.distance_radii * radius;
  const Nearest ahead = nearestBetween(robot, -35 * kRadPerDeg, 35 * kRadPerDeg);
  const Nearest right = nearestBetween(robot, -150 * kRadPerDeg, -20 * kRadPerDeg);
  // In front of an obstacle it stops at the wall's distance, and turns left on the spot.
  const double braking = std::sqrt(2 * limits.decel_mps2 * std::max(0.0, ahead.clearance_m - 0.8 * distance));
  const double cruise = std::min(0.6 * limits.speed_max_mps, braking);
  const std::uint64_t now = robot.stepNumber();
  if (robot.stalled()) {
    turn_until_ = now + robot.stepsIn(kTouchTurn_rad / (kTurnFraction * limits.turn_max_radps));
    ahead_until_ = turn_until_ + robot.stepsIn(kTouchAhead_s);
  }
  if (ahead.clearance_m < distance || now < turn_until_) {
    found_wall_ = true;
    arc_rad_ = 0;
    robot.drive(0, kTurnFraction * limits.turn_max_radps);
    return;
  }
  if (right.clearance_m > 3 * distance) {
    // No wall: drive straight to find one, or around the corner where it ended.
    const bool rounds_corner = found_wall_ && now >= ahead_until_;
    const double turn = rounds_corner ? std::max(-cruise / (distance + radius), -limits.turn_max_radps) : 0;
    arc_rad_ -= turn * robot.readings().time.period_s;
    if (arc_rad_ > 2 * std::numbers::pi) found_wall_ = false;
    robot.drive(cruise, turn);
    return;
  }
  found_wall_ = true;
  arc_rad_ = 0;
  // Steers so that the wall's nearest point is to the right, at the set distance.
  const double along = right.bearing_rad + std::numbers::pi / 2;
  const double off = std::clamp((distance - right.clearance_m) / distance, -1.0, 1.0);
  const double turn = std::clamp(1.5 * along + 0.8 * off, -0.8, 0.8);
  robot.drive(cruise * (1 - 0.7 * std::abs(turn)), std::clamp(turn, -limits.turn_max_radps, limits.turn_max_radps));
}

}  // namespace robosim
