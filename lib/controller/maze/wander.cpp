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

Clearance clearanceInFront(const Robot& robot) {
  Clearance clearance;
  const SensorKind kind = robot.sensor(SensorKind::sonar) ? SensorKind::sonar : SensorKind::infrared;
  const SensorInfo* sensor = robot.sensor(kind);
  if (!sensor) return clearance;
  const double radius = robot.info().radius_m;
  for (const Echo& echo : robot.echoes(kind)) {
    const double x = echo.point_m.x, y = echo.point_m.y;
    // Ignores echoes beside the robot's lane.
    if (x <= 0 || std::abs(y) > 1.5 * radius || !isEcho(*sensor, echo)) continue;
    double& side = y >= 0 ? clearance.left : clearance.right;
    side = std::min(side, std::sqrt(x * x + y * y) - radius);
  }
  return clearance;
}

}  // namespace

void Wander::step(Robot& robot) {
  if (recovery_.takesOver(robot)) return;
  const MotionLimits& limits = robot.info().limits;
  const double radius = robot.info().radius_m;
  const std::uint64_t now = robot.stepNumber();
  const Clearance clearance = clearanceInFront(robot);
  const bool near = clearance.ahead() < kNear * radius || robot.stalled();
  // An obstacle met during a slight turn requires a new decision at once: a stall is reported for one step only.
  if (now >= turn_until_ || (near && std::abs(turn_) < kAvoidTurn)) {
    Rng rng(setup_.seed, RandomPurpose::controller, setup_.robot, 0, now);
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
    speed *= robot.stalled()
                 ? 0
                 : std::clamp((clearance.ahead() / radius - kVeryNear) / (kNear - kVeryNear), 0.0, 1.0) * 0.5;
  } else {
    // Slow enough to brake before the obstacle ahead.
    speed = std::min(speed, std::sqrt(2 * limits.decel_mps2 * std::max(0.0, clearance.ahead() - kVeryNear * radius)));
  }
  robot.drive(speed, turn_ * limits.turn_max_radps);
}

}  // namespace robosim
