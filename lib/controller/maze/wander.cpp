#include "maze/wander.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr double kNear = 2;         // distance from the edge in robot radii at which it turns
constexpr double kVeryNear = 0.7;   // distance at which it stops
constexpr double kAvoidTurn = 0.4;  // minimum fraction of the maximum turn rate when it turns from an obstacle

/// Clearance [m] between the robot's edge and the nearest echo in the front half, left and right of its heading.
struct Clearance {
  double left = 1e9, right = 1e9;
  double ahead() const { return std::min(left, right); }
};

/// @param info,readings of the robot: each call of its hardware is virtual
Clearance clearanceInFront(const Robot& robot, const RobotInfo& info, const Readings& readings) {
  Clearance clearance;
  const auto sonar = robot.slotOf(SensorKind::sonar);
  const auto slot = sonar ? sonar : robot.slotOf(SensorKind::infrared);
  if (!slot) return clearance;
  const SensorInfo& sensor = (*info.sensors)[*slot];
  const double radius = info.radius_m;
  const double half_lane = 1.5 * radius;
  for (const Echo& echo : std::get<Echoes>(readings.measurements[*slot])) {
    // Ignores echoes beside the robot's lane.
    if (echo.point_m.x <= 0) continue;
    const double x = echo.point_m.x, y = echo.point_m.y;
    if (std::abs(y) > half_lane || !isEcho(sensor, echo)) continue;
    double& side = y >= 0 ? clearance.left : clearance.right;
    side = std::min(side, std::sqrt(x * x + y * y) - radius);
  }
  return clearance;
}

}  // namespace

void Wander::step(Robot& robot) {
  if (recovery_.takesOver(robot)) return;
  const RobotInfo& info = robot.info();
  const Readings& readings = robot.readings();
  const MotionLimits& limits = info.type->limits;
  const double radius = info.radius_m;
  const auto now = static_cast<std::uint32_t>(readings.time.step);
  const Clearance clearance = clearanceInFront(robot, info, readings);
  const bool near = clearance.ahead() < kNear * radius || readings.stalled;
  // An obstacle met during a slight turn requires a new decision at once: a stall is reported for one step only.
  if (now >= turn_until_ || (near && std::abs(turn_) < kAvoidTurn)) {
    Rng rng(recovery_.seed(), RandomPurpose::controller, recovery_.robot(), 0, now);
    if (near) {
      turn_ = std::copysign(rng.uniform(kAvoidTurn, 0.9), clearance.left - clearance.right);
      turn_until_ = now + 3 + rng.below(12);  // prevents oscillation in corners
    } else {
      turn_ = rng.below(4) == 0 ? rng.uniform(-0.3, 0.3) : 0;
      turn_until_ = now + 10 + rng.below(30);
    }
  }
  double speed = limits.speed_max_mps;
  if (near) {
    speed *= readings.stalled
                 ? 0
                 : std::clamp((clearance.ahead() / radius - kVeryNear) / (kNear - kVeryNear), 0.0, 1.0) * 0.5;
  } else {
    // Slow enough to brake before the obstacle ahead.
    speed = std::min(speed, std::sqrt(2 * limits.decel_mps2 * std::max(0.0, clearance.ahead() - kVeryNear * radius)));
  }
  robot.drive(speed, turn_ * limits.turn_max_radps);
}

}  // namespace robosim
