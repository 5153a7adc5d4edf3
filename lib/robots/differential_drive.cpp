#include "robots/differential_drive.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

double approached(double now, double wish, double gain, double loss) {
  if (now < 0 || (now == 0 && wish < 0)) return -approached(-now, -wish, gain, loss);
  if (wish >= now) return std::min(wish, now + gain);
  // Braking ends at a stand; driving the other way begins in the next step.
  return std::max({wish, now - loss, 0.0});
}

double finiteWithin(double wish, double most) { return std::isfinite(wish) ? std::clamp(wish, -most, most) : 0; }

}  // namespace

DriveSpeeds reachableSpeeds(const DriveSpeeds& now, const Command& wish, const MotionLimits& limits, double period_s) {
  const bool active = wish.activity == Activity::active;
  const double speed = active ? finiteWithin(wish.speed_mps, limits.speed_max_mps) : 0;
  const double turn = active ? finiteWithin(wish.turn_radps, limits.turn_max_radps) : 0;
  const double turn_change = limits.turn_accel_radps2 * period_s;
  return {approached(now.speed_mps, speed, limits.accel_mps2 * period_s, limits.decel_mps2 * period_s),
          approached(now.turn_radps, turn, turn_change, turn_change)};
}

Path pathOf(const mrpt::math::TPose2D& world_from_robot, const DriveSpeeds& speeds, double period_s) {
  return {world_from_robot, speeds.speed_mps * period_s, speeds.turn_radps * period_s, 1};
}

}  // namespace robosim
