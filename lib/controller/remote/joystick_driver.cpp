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

/// Whether a button that stops has been pressed since the last call.
bool JoystickDriver::stops(const StickState& state) {
  constexpr std::size_t first = 4;  // index of button 5
  const std::vector<bool> before = std::move(stop_pressed_);
  stop_pressed_.assign(state.buttons.size() - std::min(state.buttons.size(), first), false);
  bool is_new = false;
  for (std::size_t i = 0; i < stop_pressed_.size(); ++i) {
    stop_pressed_[i] = state.buttons[first + i];
    is_new |= stop_pressed_[i] && !(i < before.size() && before[i]);
  }
  return is_new;
}

bool JoystickDriver::isNeutral(double speed, double turn) const {
  const bool is_stop_held = std::find(stop_pressed_.begin(), stop_pressed_.end(), true) != stop_pressed_.end();
  return speed == 0 && turn == 0 && !pressed_[3] && !pressed_[4] && !is_stop_held;
}

void JoystickDriver::setCommanded(double part, Clock::time_point now) {
  if (!set_ || now - *set_ >= kConfirm) commanded_ = part;
}

/// Whether ACCELERATE (1) or DECELERATE (-1) keeps to the top speed; if so, notes the new speed. The robot rounds its
/// speed to tenths (DriveCommandFilter).
bool JoystickDriver::mayChangeSpeed(int tenths, Clock::time_point now) {
  constexpr double kTenths = 10;
  const double next = (static_cast<double>(std::lround(kTenths * commanded_)) + tenths) / kTenths;
  const bool is_faster = std::abs(next) > std::abs(commanded_);
  // At its own maximum the robot limits the speed itself.
  if (is_faster && top_speed_ < 1 && std::abs(next) > top_speed_ + 1e-9) return false;
  commanded_ = std::clamp(next, -1.0, 1.0);
  set_ = now;
  return true;
}

JoystickDriver::Output JoystickDriver::convert(const StickState& state, const MotionLimits& limits,
                                               Clock::time_point now) {
  Output output{.order = makeOrder(OrderType::alive)};
  output.switches = isPressed(state, 1, false, now);
  output.checks_win = isPressed(state, 2, false, now);
  const bool accelerates = isPressed(state, 3, true, now);
  const bool decelerates = isPressed(state, 4, true, now);
  const double speed = -top_speed_ * shaped(state.y);
  const double turn = -shaped(state.x);
  const bool is_stop = stops(state);
  is_neutral_ = isNeutral(speed, turn);
  if (!is_neutral_ || output.switches || output.checks_win) input_ = now;
  if (is_stop) {
    latch();
    output.order = stopOrder();
    return output;
  }
  if (is_neutral_) is_latched_ = false;
  if (input_ && now - *input_ >= kPresence) {
    input_.reset();
    latch();
    output.order = stopOrder("received no joystick input for 5 s");
    return output;
  }
  if (!input_) output.order.reset();
  if (is_latched_ || !input_) return output;
  const OrderType step = accelerates ? OrderType::accelerate : OrderType::decelerate;
  if ((accelerates || decelerates) && mayChangeSpeed(rowOf(step).speed_tenths, now)) {
    // The robot executes one order per step: the stick's order follows at the next call.
    output.order = makeOrder(step);
    return output;
  }
  std::optional<double> speed_mps, turn_radps;
  if (std::exchange(steers_speed_, speed != 0) || speed != 0) {
    commanded_ = speed;
    set_ = now;
    speed_mps = speed * limits.speed_max_mps;
  }
  if (std::exchange(steers_turn_, turn != 0) || turn != 0) turn_radps = turn * limits.turn_max_radps;
  if (speed_mps || turn_radps) output.order = driveOrder(speed_mps, turn_radps);
  return output;
}

void JoystickDriver::latch() {
  is_latched_ = !is_neutral_;
  steers_speed_ = steers_turn_ = false;
  commanded_ = 0;
}

}  // namespace robosim
