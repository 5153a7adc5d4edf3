#include "robots/drive_kinematics.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"

namespace robosim {
namespace {

double tangentOf(double angle_rad) {
  const auto [sin, cos] = portable::sincos(angle_rad);
  return sin / cos;
}

/// The origin of a robot that turns about another point moves sideways.
void setAside(const Drive& drive, DriveMotion& motion) {
  if (drive.icr_x_m != 0) motion.state.lateral_mps = -motion.speeds.turn_radps * drive.icr_x_m;
}

DriveMotion omni(const DriveMotion& now, const Command& target, const MotionLimits& limits, double period_s) {
  DriveMotion reached{reachableSpeeds(now.speeds, target, limits, period_s), {}};
  Command aside = target;
  aside.speed_mps = target.lateral_mps;
  MotionLimits lateral = limits;
  lateral.speed_max_mps = limits.lateral_max_mps;
  reached.state.lateral_mps = reachableSpeeds({now.state.lateral_mps, 0}, aside, lateral, period_s).speed_mps;
  return reached;
}

/// Angle of the front wheels that a command asks for; `now_rad` if it asks for none.
double steeringTarget(const Drive& drive, double now_rad, const Command& target, const MotionLimits& limits) {
  const bool may_drive = target.activity == Activity::active && !target.emergency_stop;
  if (!may_drive || target.speed_mps == 0 || !std::isfinite(target.speed_mps) || !std::isfinite(target.turn_radps)) {
    return now_rad;
  }
  const double speed_mps = std::clamp(target.speed_mps, -limits.speed_max_mps, limits.speed_max_mps);
  const double turn_radps = std::clamp(target.turn_radps, -limits.turn_max_radps, limits.turn_max_radps);
  const double angle_rad = portable::atan2(drive.wheelbase_m * turn_radps, std::abs(speed_mps));
  return std::clamp(speed_mps < 0 ? -angle_rad : angle_rad, -drive.steering_max_rad, drive.steering_max_rad);
}

DriveMotion car(const Drive& drive, const DriveMotion& now, const Command& target, const MotionLimits& limits,
                double period_s) {
  DriveMotion reached;
  reached.speeds.speed_mps = reachableSpeeds({now.speeds.speed_mps, 0}, target, limits, period_s).speed_mps;
  double& steering_rad = reached.state.steering_rad;
  steering_rad = steeringTarget(drive, now.state.steering_rad, target, limits);
  if (drive.steering_rate_radps > 0) {
    const double most_rad = drive.steering_rate_radps * period_s;
    steering_rad = now.state.steering_rad + std::clamp(steering_rad - now.state.steering_rad, -most_rad, most_rad);
    // The sum may be rounded beyond the end of the way.
    steering_rad = std::clamp(steering_rad, -drive.steering_max_rad, drive.steering_max_rad);
  }
  const double turn_radps = reached.speeds.speed_mps * tangentOf(steering_rad) / drive.wheelbase_m;
  reached.speeds.turn_radps = std::clamp(turn_radps, -limits.turn_max_radps, limits.turn_max_radps);
  setAside(drive, reached);
  return reached;
}

DriveMotion tracked(const Drive& drive, const DriveMotion& now, const Command& target, const MotionLimits& limits,
                    double period_s) {
  const DriveSpeeds of_tracks{now.speeds.speed_mps, now.speeds.turn_radps / drive.turnShare()};
  DriveMotion reached{reachableSpeeds(of_tracks, target, limits, period_s), {}};
  reached.speeds.turn_radps *= drive.turnShare();
  setAside(drive, reached);
  return reached;
}

}  // namespace

DriveMotion reachableMotion(const Drive& drive, const DriveMotion& now, const Command& target,
                            const MotionLimits& limits, double period_s) {
  switch (drive.kind) {
    case DriveKind::differential:
      break;
    case DriveKind::omni:
      return omni(now, target, limits, period_s);
    case DriveKind::car:
      return car(drive, now, target, limits, period_s);
    case DriveKind::tracked:
      return tracked(drive, now, target, limits, period_s);
  }
  return {reachableSpeeds(now.speeds, target, limits, period_s), {}};
}

Path pathOf(const Drive& drive, const mrpt::math::TPose2D& world_from_robot, const DriveMotion& motion,
            double period_s) {
  Path path = pathOf(world_from_robot, motion.speeds, period_s);
  path.turn_stops = drive.kind == DriveKind::car;
  const double aside_m = motion.state.lateral_mps * period_s;
  if (aside_m == 0) return path;
  path.direction_rad = portable::atan2(aside_m, path.length_m);
  path.length_m = portable::hypot(path.length_m, aside_m);
  return path;
}

DriveMotion stopped(const Drive& drive, const DriveMotion& motion) {
  DriveMotion rest = motion;
  rest.speeds.speed_mps = rest.state.lateral_mps = 0;
  if (drive.kind == DriveKind::car) rest.speeds.turn_radps = 0;
  return rest;
}

double groundSpeedMax(const Drive& drive, const MotionLimits& limits) {
  double lateral_mps = limits.lateral_max_mps;
  if (drive.icr_x_m != 0) lateral_mps = std::abs(drive.icr_x_m) * limits.turn_max_radps * drive.turnShare();
  return lateral_mps == 0 ? limits.speed_max_mps : portable::hypot(limits.speed_max_mps, lateral_mps);
}

}  // namespace robosim
