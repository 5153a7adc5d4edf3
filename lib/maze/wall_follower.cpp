#include "maze/wall_follower.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/echo.h"

namespace robosim {
namespace {

/// The nearest echo between two bearings [rad], from the robot's edge.
struct Nearest {
  double room_m = 1e9;
  double bearing_rad = 0;
};

Nearest nearestBetween(const Robot& robot, double from_rad, double to_rad) {
  Nearest nearest;
  const SensorInfo* sonar = robot.sensor(SensorKind::sonar);
  if (!sonar) return nearest;
  for (const Echo& echo : robot.sonar()) {
    if (!heard(*sonar, echo)) continue;
    const double bearing = std::atan2(echo.point_m.y, echo.point_m.x);
    const double room = std::hypot(echo.point_m.x, echo.point_m.y) - robot.info().radius_m;
    if (from_rad <= bearing && bearing <= to_rad && room < nearest.room_m) nearest = {room, bearing};
  }
  return nearest;
}

constexpr double kDeg = std::numbers::pi / 180;

}  // namespace

void WallFollower::step(Robot& robot) {
  const MotionLimits& limits = robot.info().limits;
  const double radius = robot.info().radius_m;
  const double distance = options_.distance_radii * radius;
  const Nearest ahead = nearestBetween(robot, -35 * kDeg, 35 * kDeg);
  const Nearest right = nearestBetween(robot, -150 * kDeg, -20 * kDeg);
  // Before what is ahead it stops at the wall's distance, and turns left on the spot.
  const double braking = std::sqrt(2 * limits.decel_mps2 * std::max(0.0, ahead.room_m - 0.8 * distance));
  const double cruise = std::min(0.6 * limits.speed_max_mps, braking);
  if (ahead.room_m < distance || robot.stalled()) {
    found_wall_ = true;
    robot.drive(0, 0.6 * limits.turn_max_radps);
    return;
  }
  if (right.room_m > 3 * distance) {
    // No wall: straight on to find one, or round the corner where it ended.
    const double turn = found_wall_ ? -cruise / (distance + radius) : 0;
    robot.drive(cruise, std::max(turn, -limits.turn_max_radps));
    return;
  }
  found_wall_ = true;
  // Steers so that the wall's nearest point comes to lie straight to the right, and as far away as it should be.
  const double along = right.bearing_rad + std::numbers::pi / 2;
  const double off = std::clamp((distance - right.room_m) / distance, -1.0, 1.0);
  const double turn = std::clamp(1.5 * along + 0.8 * off, -0.8, 0.8);
  robot.drive(cruise * (1 - 0.7 * std::abs(turn)), std::clamp(turn, -limits.turn_max_radps, limits.turn_max_radps));
}

}  // namespace robosim
