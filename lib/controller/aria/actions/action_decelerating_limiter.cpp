#include "aria/actions/action_decelerating_limiter.h"

#include <algorithm>
#include <cmath>

#include "aria/pioneer_robot.h"

namespace robosim {
namespace {

constexpr double kReach_mm = 30000;
constexpr double kHardest_mmps2 = 1e9;  ///< replaced by the hardware's limit

/// Highest speed [mm/s] from which the robot stops within a distance [mm].
double speedToStopWithin(double distance, double decel) { return std::sqrt(2 * decel * std::max(distance, 0.0)); }

}  // namespace

ActionDeceleratingLimiter::ActionDeceleratingLimiter(std::string name, bool forwards)
    : Action(std::move(name)), forwards_(forwards) {}

ActionDesired ActionDeceleratingLimiter::fire(PioneerRobot& robot, const ActionDesired&) {
  const Parameters& p = parameters_;
  const double direction = forwards_ ? 1 : -1;
  const double speed = std::max(0.0, direction * robot.getVel());
  const double fast = std::clamp((speed - p.slow_speed) / (p.fast_speed - p.slow_speed), 0.0, 1.0);
  const double side = std::lerp(p.side_clearance_at_slow_speed, p.side_clearance_at_fast_speed, fast);
  const double padding = std::lerp(p.padding_at_slow_speed, p.padding_at_fast_speed, fast);

  ActionDesired desired;
  const double radius = robot.getRobotRadius();
  const double half_lane = radius + side;
  PioneerPose obstacle{.x = direction * kReach_mm, .y = 0, .th = 0};
  robot.checkRangeDevicesCurrentBox(direction * radius, -half_lane, direction * kReach_mm, half_lane, &obstacle);
  const double room = direction * obstacle.x - radius - p.clearance;
  const double allowed = std::max(speedToStopWithin(room - padding, p.preferred_decel),
                                  std::min(p.slow_speed, speedToStopWithin(room, p.preferred_decel)));
  if (forwards_) {
    desired.setMaxVel(allowed);
  } else {
    desired.setMaxNegVel(-allowed);
  }
  if (speed <= allowed) return desired;
  const double hardest = p.max_emergency_decel > 0 ? p.max_emergency_decel : kHardest_mmps2;
  const double required = room > 0 ? speed * speed / (2 * room) : hardest;
  const bool stops_at_once = room <= 0 && p.use_estop;
  desired.setTransDecel(stops_at_once ? kHardest_mmps2
                                      : std::clamp(required, std::min(p.preferred_decel, hardest), hardest));
  return desired;
}

}  // namespace robosim
