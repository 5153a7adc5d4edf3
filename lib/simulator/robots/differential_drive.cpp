#include "robots/differential_drive.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

double approached(double now, double target, double gain, double loss) {
  if (now < 0 || (now == 0 && target < 0)) return -approached(-now, -target, gain, loss);
  if (target >= now) return std::min(target, now + gain);
  // Braking ends at 0; acceleration in the other direction begins in the next step.
  return std::max({target, now - loss, 0.0});
}

double clampedOrZero(double target, double limit) {
  return std::isfinite(target) ? std::clamp(target, -limit, limit) : 0;
}

}  // namespace

DriveSpeeds reachableSpeeds(const DriveSpeeds& now, const Command& target, const MotionLimits& limits,
                            double period_s) {
  const bool may_drive = target.activity == Activity::active && !target.emergency_stop;
  const double speed = may_drive ? clampedOrZero(target.speed_mps, limits.speed_max_mps) : 0;
  const double turn = may_drive ? clampedOrZero(target.turn_radps, limits.turn_max_radps) : 0;
  const double turn_change = limits.turn_accel_radps2 * period_s;
  const double harder = target.emergency_stop ? std::max(1.0, limits.emergency_decel_mps2 / limits.decel_mps2) : 1;
  return {approached(now.speed_mps, speed, limits.accel_mps2 * period_s, harder * limits.decel_mps2 * period_s),
          approached(now.turn_radps, turn, turn_change, harder * turn_change)};
}

Path pathOf(const mrpt::math::TPose2D& world_from_robot, const DriveSpeeds& speeds, double period_s) {
  return {world_from_robot, speeds.speed_mps * period_s, speeds.turn_radps * period_s, 1};
}

}  // namespace robosim
