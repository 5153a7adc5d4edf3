#include "remote/stick_pilot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace robosim {

double StickPilot::shaped(double deflection) {
  const double rest = std::clamp((std::abs(deflection) - kDeadZone) / (1 - kDeadZone), 0.0, 1.0);
  return std::copysign(0.4 * rest + 0.6 * rest * rest, deflection);
}

/// Whether a press counts now: when it comes, and if it repeats, again and again.
bool StickPilot::isPressed(const StickState& state, std::size_t button, bool repeats, Clock::time_point now) {
  auto& last = pressed_[button];
  if (button > state.buttons.size() || !state.buttons[button - 1]) {
    last.reset();
    return false;
  }
  if (last && !(repeats && now - *last >= kRepeat)) return false;
  last = now;
  return true;
}

StickPilot::Wish StickPilot::wish(const StickState& state, const MotionLimits& limits, Clock::time_point now) {
  Wish wish;
  wish.switches = isPressed(state, 1, false, now);
  wish.checks_win = isPressed(state, 2, false, now);
  const bool accelerates = isPressed(state, 3, true, now);
  const bool decelerates = isPressed(state, 4, true, now);
  if (accelerates || decelerates) {
    // The handle has its say next time: the robot obeys one order a step.
    wish.order.type = accelerates ? RemoteType::accelerate : RemoteType::decelerate;
    return wish;
  }
  const double speed = -shaped(state.y);
  const double turn = -shaped(state.x);
  if (std::exchange(steers_speed_, speed != 0) || speed != 0) wish.order.speed_mps = speed * limits.speed_max_mps;
  if (std::exchange(steers_turn_, turn != 0) || turn != 0) wish.order.turn_radps = turn * limits.turn_max_radps;
  if (wish.order.speed_mps || wish.order.turn_radps) wish.order.type = RemoteType::drive;
  return wish;
}

}  // namespace robosim
