#include "maze/pushing/disc_pusher.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"
#include "maze/pushing/low_objects.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

constexpr double kPi = std::numbers::pi;
constexpr double kLook_m = 0.5;           // distance, from the robot's edge, within which obstacles are avoided
constexpr double kMargin_m = 0.04;        // gap that is kept to them
constexpr double kHeadingGain_per_s = 4;  // turn rate per heading error
constexpr double kTurnFirst_rad = 1.0;    // heading error beyond which the robot turns on the spot
constexpr double kPushGap_m = 0.05;       // gap to a disc that is being pushed
constexpr double kBehind_rad = 0.8;       // largest error of a robot that pushes
constexpr double kApproachBend = 1.6;  // curvature of the approach; 1 is the arc that ends in the direction of the push
constexpr double kSpiral_rad = 0.8;    // largest angle between a distant disc and the robot's course
constexpr double kPass_m = 0.12;       // gap that is kept to a disc on the way round it

constexpr double kGripFrom_m = 0.25;     // gap to a disc from which a robot drives straight to grip it
constexpr double kGripRoom_m = 0.05;     // gap that it keeps while it turns to the disc
constexpr double kGripAhead_rad = 0.08;  // largest bearing of a disc that it grips
constexpr double kGripSpeed_mps = 0.1;   // at which it drives to grip

double wayBearing(const TPoint2D& offset) { return portable::atan2(offset.y, offset.x); }
double wayLength(const TPoint2D& offset) { return portable::hypot(offset.x, offset.y); }
TPoint2D from(const TPose2D& robot, const TPoint2D& place) { return {place.x - robot.x, place.y - robot.y}; }

/// Whether a motion in a direction would come closer than the margin to an echo, within the distance of the look.
bool isBlocked(const Echoes& echoes, double direction_rad, double radius_m) {
  const auto [sin, cos] = portable::sincos(direction_rad);
  const double lane_m = radius_m + kMargin_m;
  for (const Echo& echo : echoes) {
    if (echo.range_m > radius_m + kLook_m) continue;
    const double along = echo.point_m.x * cos + echo.point_m.y * sin;
    const double aside = echo.point_m.y * cos - echo.point_m.x * sin;
    // An echo within the margin blocks only what leads closer to it.
    if (along > 0.3 * echo.range_m && std::abs(aside) < lane_m) return true;
  }
  return false;
}

/// The direction nearest to the wanted one that is not blocked; the wanted one if all are.
double freeDirection(const Robot& robot, double wanted_rad) {
  const Measurement* measurement = robot.measurement(kHighLaser);
  const Echoes* echoes = measurement ? std::get_if<Echoes>(measurement) : nullptr;
  if (!echoes) return wanted_rad;
  const double radius_m = robot.info().radius_m;
  constexpr double kStep_rad = kPi / 18;
  for (int i = 0; i <= 13; ++i) {
    for (const double side : {1.0, -1.0}) {
      const double direction_rad = wanted_rad + side * i * kStep_rad;
      if (!isBlocked(*echoes, direction_rad, radius_m)) return direction_rad;
    }
  }
  return wanted_rad;
}

void steerBy(Robot& robot, double bearing_rad, double speed_mps) {
  const MotionLimits& limits = robot.info().type->limits;
  const double turn_radps = std::clamp(kHeadingGain_per_s * bearing_rad, -limits.turn_max_radps, limits.turn_max_radps);
  const double share = std::max(0.0, 1 - std::abs(bearing_rad) / kTurnFirst_rad);
  robot.drive(speed_mps * share, turn_radps);
}

}  // namespace

void driveTowards(Robot& robot, double bearing_rad, double speed_mps) {
  steerBy(robot, wrapToPi(freeDirection(robot, wrapToPi(bearing_rad))), speed_mps);
}

bool driveTo(Robot& robot, const TPose2D& map_from_robot, const TPoint2D& place, double speed_mps, double tolerance_m) {
  const TPoint2D way = from(map_from_robot, place);
  const double distance_m = wayLength(way);
  if (distance_m <= tolerance_m) {
    robot.stop();
    return true;
  }
  const double braking_mps = std::sqrt(robot.info().type->limits.decel_mps2 * distance_m);
  driveTowards(robot, wayBearing(way) - map_from_robot.phi, std::min(speed_mps, braking_mps));
  return false;
}

double pushError(const PushTask& task, const TPose2D& map_from_robot) {
  return wrapToPi(wayBearing(from(map_from_robot, task.disc)) - wayBearing(task.target - task.disc));
}

void pushDisc(Robot& robot, const TPose2D& map_from_robot, const PushTask& task, double speed_mps) {
  const TPoint2D way = from(map_from_robot, task.disc);
  const double distance_m = wayLength(way);
  const double contact_m = robot.info().radius_m + task.radius_m;
  const double error_rad = pushError(task, map_from_robot);
  const double bearing_rad = wrapToPi(wayBearing(way) - map_from_robot.phi);
  if (distance_m < contact_m + kPushGap_m && std::abs(error_rad) < kBehind_rad && std::abs(bearing_rad) < 1) {
    // The line through both turns at speed · sin(bearing) / contact distance.
    const double wanted_rad = std::clamp(-error_rad, -0.45, 0.45);
    const double line_radps = speed_mps * portable::sin(bearing_rad) / contact_m;
    const double turn_radps = line_radps + kHeadingGain_per_s * (bearing_rad - wanted_rad);
    const double turn_max_radps = robot.info().type->limits.turn_max_radps;
    const double share = std::clamp(1.3 - std::abs(bearing_rad - wanted_rad), 0.2, 1.0);
    robot.drive(speed_mps * share, std::clamp(turn_radps, -turn_max_radps, turn_max_radps));
    return;
  }
  // Round the disc, at most along a tangent of the circle that passes it.
  const double pass_m = contact_m + kPass_m;
  double tangent_rad = kPi / 2 + std::min(1.0, (pass_m - distance_m) / kPass_m) * kPi / 6;
  if (distance_m > pass_m) {
    tangent_rad = portable::atan2(pass_m, std::sqrt(distance_m * distance_m - pass_m * pass_m));
  }
  const double offset_rad = std::min(kApproachBend * std::abs(error_rad), std::max(tangent_rad, kSpiral_rad));
  driveTowards(robot, bearing_rad + std::copysign(offset_rad, error_rad), speed_mps);
}

void gripDisc(Robot& robot, const TPose2D& map_from_robot, const TPoint2D& disc, double radius_m, double speed_mps) {
  const TPoint2D way = from(map_from_robot, disc);
  const double gap_m = wayLength(way) - robot.info().radius_m - radius_m;
  const double bearing_rad = wrapToPi(wayBearing(way) - map_from_robot.phi);
  const bool was_closed = robot.command().grip;
  robot.release();
  if (gap_m > kGripFrom_m) {
    driveTowards(robot, bearing_rad, speed_mps);
    return;
  }
  const bool is_ahead = std::abs(bearing_rad) < kGripAhead_rad;
  if (is_ahead && robot.gripper().inner_beam && !was_closed) robot.grip();
  // From near, it turns on the spot first, and then drives straight.
  const double creep_mps = std::min(speed_mps, kGripSpeed_mps);
  if (is_ahead) {
    robot.drive(creep_mps, kHeadingGain_per_s * bearing_rad / 2);
  } else {
    robot.drive(gap_m < kGripRoom_m ? -creep_mps : 0, std::clamp(kHeadingGain_per_s * bearing_rad, -1.0, 1.0));
  }
}

}  // namespace robosim
