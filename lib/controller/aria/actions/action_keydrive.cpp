#include "aria/actions/action_keydrive.h"

#include <algorithm>

#include "aria/pioneer_robot.h"

namespace robosim {

ActionKeydrive::ActionKeydrive(std::string name, double trans_vel_max, double turn_amount_max, double vel_increment,
                               double turn_increment)
    : Action(std::move(name)),
      trans_vel_max_(trans_vel_max),
      turn_amount_max_(turn_amount_max),
      vel_increment_(vel_increment),
      turn_increment_(turn_increment) {}

void ActionKeydrive::setSpeeds(double trans_vel_max, double turn_amount_max) {
  trans_vel_max_ = trans_vel_max;
  turn_amount_max_ = turn_amount_max;
}

void ActionKeydrive::setIncrements(double vel_increment, double turn_increment) {
  vel_increment_ = vel_increment;
  turn_increment_ = turn_increment;
}

void ActionKeydrive::left() { turn_ = std::min(turn_ + turn_increment_, turn_amount_max_); }
void ActionKeydrive::right() { turn_ = std::max(turn_ - turn_increment_, -turn_amount_max_); }

void ActionKeydrive::space() {
  speed_ = speed_change_ = turn_ = 0;
  was_overruled_ = false;
}

void ActionKeydrive::setRobot(PioneerRobot* robot) {
  Action::setRobot(robot);
  keys_.release();
}

void ActionKeydrive::deactivate() {
  Action::deactivate();
  keys_.release();
  space();
}

ActionDesired ActionKeydrive::fire(PioneerRobot& robot, const ActionDesired& current) {
  // Here and not in activate(): the handler may be attached later, and another action may hold the keys until then.
  keys_.claim(robot.getKeyHandler(), {{KeyHandler::UP, [this] { up(); }},
                                      {KeyHandler::DOWN, [this] { down(); }},
                                      {KeyHandler::LEFT, [this] { left(); }},
                                      {KeyHandler::RIGHT, [this] { right(); }},
                                      {KeyHandler::SPACE, [this] { space(); }}});
  if (was_overruled_) speed_ = std::clamp(robot.getVel(), std::min(speed_, 0.0), std::max(speed_, 0.0));
  was_overruled_ = current.getVelStrength() >= ActionDesired::MAX_STRENGTH;
  speed_ = std::clamp(speed_, current.getMaxNegVel(), current.getMaxVel());
  speed_ = std::clamp(speed_ + speed_change_, -trans_vel_max_, trans_vel_max_);
  ActionDesired desired;
  desired.setVel(speed_);
  desired.setDeltaHeading(turn_);
  speed_change_ = turn_ = 0;
  return desired;
}

}  // namespace robosim
