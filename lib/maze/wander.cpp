#include "maze/wander.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr double kNear = 2;        // robot radii from its edge: it turns
constexpr double kVeryNear = 0.7;  // and here it stops for it

/// Room [m] between the robot's edge and the nearest echo in the front half, left and right of its heading.
struct Room {
  double left = 1e9, right = 1e9;
  double ahead() const { return std::min(left, right); }
};

Room roomInFront(const Robot& robot) {
  Room room;
  const SensorInfo* sonar = robot.sensor(SensorKind::sonar);
  if (!sonar) return room;
  const double radius = robot.info().radius_m;
  for (const Echo& echo : robot.sonar()) {
    const double x = echo.point_m.x, y = echo.point_m.y;
    // Beside the robot things do not matter; only what is nearer to its course than it is wide.
    if (x <= 0 || std::abs(y) > 1.5 * radius || !heard(*sonar, echo)) continue;
    double& side = y >= 0 ? room.left : room.right;
    side = std::min(side, std::sqrt(x * x + y * y) - radius);
  }
  return room;
}

}  // namespace

void Wander::step(Robot& robot) {
  const MotionLimits& limits = robot.info().limits;
  const double radius = robot.info().radius_m;
  const std::uint64_t now = robot.stepNumber();
  const Room room = roomInFront(robot);
  const bool near = room.ahead() < kNear * radius || robot.stalled();
  if (now >= turn_until_) {
    Rng rng(setup_.seed, RandomPurpose::controller, setup_.robot, 0, now);
    if (near) {
      turn_ = std::copysign(rng.uniform(0.4, 0.9), room.left - room.right);
      turn_until_ = now + 3 + rng.below(12);  // a while, so that it does not dither in a corner
    } else {
      turn_ = rng.below(4) == 0 ? rng.uniform(-0.3, 0.3) : 0;
      turn_until_ = now + 10 + rng.below(30);
    }
  } else if (near && std::abs(turn_) < 0.4) {
    turn_until_ = now;  // think again in the next step, and slow down now
  }
  double speed = limits.speed_max_mps;
  if (near) {
    speed *=
        robot.stalled() ? 0 : std::clamp((room.ahead() / radius - kVeryNear) / (kNear - kVeryNear), 0.0, 1.0) * 0.5;
  } else {
    // So slow that it could brake before what is ahead.
    speed = std::min(speed, std::sqrt(2 * limits.decel_mps2 * std::max(0.0, room.ahead() - kVeryNear * radius)));
  }
  robot.drive(speed, turn_ * limits.turn_max_radps);
}

}  // namespace robosim
