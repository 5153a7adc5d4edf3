#include "aria/action.h"

#include <algorithm>

#include "aria/pioneer_robot.h"

namespace robosim {

void DesiredChannel::fillFrom(const DesiredChannel& lower) {
  const double taken = std::min(lower.strength, 1 - strength);
  if (taken <= 0) return;
  value = (value * strength + lower.value * taken) / (strength + taken);
  strength += taken;
}

void DesiredChannel::average(const DesiredChannel& other) {
  const double sum = strength + other.strength;
  if (sum <= 0) return;
  value = (value * strength + other.value * other.strength) / sum;
  strength = sum;  // may exceed 1, so that a third counts as much as the first two; fillFrom() caps it
}

void ActionDesired::setVel(double mm_ps, double strength) { vel_ = {mm_ps, std::clamp(strength, 0.0, 1.0)}; }

void ActionDesired::setDeltaHeading(double deg, double strength) { setTurn(deg, strength, false); }

void ActionDesired::setHeading(double deg, double strength) {
  setTurn(deg, strength, false);
  is_heading_ = true;
}

void ActionDesired::accountForRobotHeading(double th_deg) {
  if (is_heading_) turn_.value = Math::subAngle(turn_.value, th_deg);
  is_heading_ = false;
}

void ActionDesired::setRotVel(double deg_ps, double strength) { setTurn(deg_ps, strength, true); }

void ActionDesired::setTurn(double value, double strength, bool by_speed) {
  turn_ = {value, std::clamp(strength, 0.0, 1.0)};
  turns_by_speed_ = by_speed;
  is_heading_ = false;
}

void ActionDesired::setMaxVel(double mm_ps) { max_vel_ = std::max(0.0, mm_ps); }

void ActionDesired::setMaxNegVel(double mm_ps) { max_neg_vel_ = std::min(0.0, mm_ps); }

void ActionDesired::setMaxRotVel(double deg_ps) { max_rot_vel_ = std::max(0.0, deg_ps); }

void ActionDesired::limitAsWell(const ActionDesired& other) {
  const auto both = [](std::optional<double>& mine, const std::optional<double>& others, const auto& better) {
    if (others) mine = mine ? better(*mine, *others) : *others;
  };
  const auto lower = [](double a, double b) { return std::min(a, b); };
  const auto higher = [](double a, double b) { return std::max(a, b); };
  max_vel_ = std::min(max_vel_, other.max_vel_);
  max_neg_vel_ = std::max(max_neg_vel_, other.max_neg_vel_);
  max_rot_vel_ = std::min(max_rot_vel_, other.max_rot_vel_);
  both(trans_accel_, other.trans_accel_, lower);
  both(trans_decel_, other.trans_decel_, higher);
  both(rot_accel_, other.rot_accel_, lower);
  both(rot_decel_, other.rot_decel_, higher);
}

void ActionDesired::fillFrom(const ActionDesired& lower) {
  vel_.fillFrom(lower.vel_);
  if (turn_.strength == 0) turns_by_speed_ = lower.turns_by_speed_;
  if (turns_by_speed_ == lower.turns_by_speed_) turn_.fillFrom(lower.turn_);
  limitAsWell(lower);
}

void ActionDesired::average(const ActionDesired& other) {
  vel_.average(other.vel_);
  if (turn_.strength == 0) turns_by_speed_ = other.turns_by_speed_;
  if (turns_by_speed_ == other.turns_by_speed_) turn_.average(other.turn_);
  limitAsWell(other);
}

void ActionList::add(Action& action, int priority) {
  const auto place = std::find_if(entries_.begin(), entries_.end(),
                                  [priority](const Entry& entry) { return entry.priority < priority; });
  entries_.insert(place, {priority, &action});
}

bool ActionList::remove(const Action& action) {
  return std::erase_if(entries_, [&action](const Entry& entry) { return entry.action == &action; }) > 0;
}

Action* ActionList::find(const std::string& name) const {
  for (const Entry& entry : entries_) {
    if (entry.action->getName() == name) return entry.action;
  }
  return nullptr;
}

void ActionList::deactivateAll() const {
  for (const Entry& entry : entries_) entry.action->deactivate();
}

ActionDesired ActionList::resolve(PioneerRobot& robot) const {
  ActionDesired settled;
  for (std::size_t i = 0; i < entries_.size();) {
    const int priority = entries_[i].priority;
    ActionDesired equals;
    for (; i < entries_.size() && entries_[i].priority == priority; ++i) {
      if (!entries_[i].action->isActive()) continue;
      ActionDesired desired = entries_[i].action->fire(robot, settled);
      desired.accountForRobotHeading(robot.getTh());
      equals.average(desired);
    }
    settled.fillFrom(equals);
  }
  return settled;
}

}  // namespace robosim
