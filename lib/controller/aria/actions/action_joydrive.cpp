#include "aria/actions/action_joydrive.h"

namespace robosim {

ActionJoydrive::ActionJoydrive(JoyHandler* joystick, std::string name, double trans_vel_max, double turn_amount_max,
                               bool stop_if_no_button_pressed)
    : Action(std::move(name)),
      joystick_(joystick),
      trans_vel_max_(trans_vel_max),
      turn_amount_max_(turn_amount_max),
      stops_(stop_if_no_button_pressed) {}

void ActionJoydrive::setSpeeds(double trans_vel_max, double turn_amount_max) {
  trans_vel_max_ = trans_vel_max;
  turn_amount_max_ = turn_amount_max;
}

ActionDesired ActionJoydrive::fire(PioneerRobot&, const ActionDesired&) {
  ActionDesired desired;
  const auto state = joystick_ ? joystick_->read() : std::nullopt;
  if (!state) return desired;
  if (isReleased(*state)) {
    desired.setVel(state->y * trans_vel_max_);
    desired.setDeltaHeading(-state->x * turn_amount_max_);
  } else if (stops_) {
    desired.setVel(0);
    desired.setDeltaHeading(0);
  }
  return desired;
}

}  // namespace robosim
