#include "remote/joystick_driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace robosim {

double JoystickDriver::shaped(double deflection) {
  const double rest = std::clamp((std::abs(deflection) - kDeadZone) / (1 - kDeadZone), 0.0, 1.0);
  return std::copysign(0.4 * rest + 0.6 * rest * rest, deflection);
}

/// Whether a button causes an order now: when it is pressed, and if it repeats, every kRepeat.
bool JoystickDriver::isPressed(const StickState& state, std::size_t button, bool repeats, Clock::time_point now) {
  auto& last = pressed_[button];
  if (button > state.buttons.size() || !state.buttons[button - 1]) {
    last.reset();
    return false;
  }
  if (last && !(repeats && now - *last >= kRepeat)) return false;
  last = now;
  return true;
}

JoystickDriver::Output JoystickDriver::convert(const StickState& state, const MotionLimits& limits,
                                               Clock::time_point now) {
  Output output;
  output.switches = isPressed(state, 1, false, now);
  output.checks_win = isPressed(state, 2, false, now);
  const bool accelerates = isPressed(state, 3, true, now);
  const bool decelerates = isPressed(state, 4, true, now);
  const double speed = -shaped(state.y);
  const double turn = -shaped(state.x);
  is_neutral_ = speed == 0 && turn == 0 && !pressed_[3] && !pressed_[4];
  if (is_neutral_) is_latched_ = false;
  if (is_latched_) return output;
  if (accelerates || decelerates) {
    // The robot executes one order per step: the stick's order follows at the next call.
    output.order.type = accelerates ? RemoteType::accelerate : RemoteType::decelerate;
    return output;
  }
  if (std::exchange(steers_speed_, speed != 0) || speed != 0) output.order.speed_mps = speed * limits.speed_max_mps;
  if (std::exchange(steers_turn_, turn != 0) || turn != 0) output.order.turn_radps = turn * limits.turn_max_radps;
  if (output.order.speed_mps || output.order.turn_radps) output.order.type = RemoteType::drive;
  return output;
}

void JoystickDriver::latch() {
  is_latched_ = !is_neutral_;
  steers_speed_ = steers_turn_ = false;
}

}  // namespace robosim
