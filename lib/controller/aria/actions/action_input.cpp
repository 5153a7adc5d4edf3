#include "aria/actions/action_input.h"

#include "aria/pioneer_robot.h"

namespace robosim {

void ActionInput::setRotVel(double deg_ps) {
  rot_vel_ = deg_ps;
  heading_.reset();
  delta_.reset();
}

void ActionInput::setHeading(double deg) {
  heading_ = deg;
  rot_vel_.reset();
  delta_.reset();
}

void ActionInput::deltaHeadingFromCurrent(double deg) {
  delta_ = deg;
  rot_vel_.reset();
  heading_.reset();
}

void ActionInput::clear() {
  vel_.reset();
  rot_vel_.reset();
  heading_.reset();
  delta_.reset();
}

void ActionInput::deactivate() {
  Action::deactivate();
  clear();
}

ActionDesired ActionInput::fire(PioneerRobot& robot, const ActionDesired&) {
  if (delta_) setHeading(Math::addAngle(robot.getTh(), *delta_));
  ActionDesired desired;
  if (vel_) desired.setVel(*vel_);
  if (rot_vel_) desired.setRotVel(*rot_vel_);
  if (heading_) desired.setHeading(*heading_);
  return desired;
}

}  // namespace robosim
