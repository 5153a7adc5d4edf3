#include "remote/joystick_control.h"

#include <utility>

namespace robosim {

/// Whether the robot has stopped for a reason of its own since the last call.
bool JoystickControl::hasStopped(const RobotNews& robot) {
  const auto before = std::exchange(stops_, robot.state.stops());
  return before && *before != robot.state.stops();
}

/// Whether the connected robot does not report.
bool JoystickControl::isLost(const RobotNews& robot, Clock::time_point now) {
  if (!updated_ || robot.update != update_) updated_ = now;
  update_ = robot.update;
  return now - *updated_ >= kLost;
}

JoystickControl::Output JoystickControl::next(const RobotNews& robot, const StickState& stick, Clock::time_point now) {
  if (!robot.info) return {};  // it has never been connected
  if (robot.update) driver_.setCommanded(robot.update->state.speed_mps() / robot.info->type->limits.speed_max_mps, now);
  const auto converted = driver_.convert(stick, robot.info->type->limits, now);
  Output output{.switches = converted.switches};
  const bool is_stop = converted.order && converted.order->has_stop();
  if (is_stop) output.orders.push_back(*converted.order);
  if (!robot.is_up || !robot.state.is_yours()) {
    driver_.latch();
    stops_.reset();
    updated_.reset();
    return output;
  }
  if (hasStopped(robot)) {
    driver_.latch();
    output.orders.push_back(stopOrder("the joystick must be released after a stop"));
    return output;
  }
  const bool is_lost = isLost(robot, now);
  const bool was_lost = std::exchange(was_lost_, is_lost);
  if (is_lost) {
    driver_.latch();
    if (!was_lost) {
      output.orders.push_back(stopOrder("it has not reported to the joystick for 2 s"));
    }
    return output;
  }
  if (converted.order && !is_stop) output.orders.push_back(*converted.order);
  if (converted.checks_win) output.orders.push_back(makeOrder(OrderType::check_win));
  return output;
}

void JoystickControl::switchRobot(Clock::time_point now) {
  driver_.latch();
  stops_.reset();
  updated_ = now;
}

}  // namespace robosim
