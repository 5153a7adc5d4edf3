#include "aria/actions/action_bumpers.h"

#include <cmath>

#include "aria/pioneer_robot.h"

namespace robosim {
namespace {

/// Turn [deg] away from a contact. @param direction of the contact [deg] from the direction of motion
double turnAwayFrom(double direction) {
  const double turn = 90 - std::abs(direction);
  return direction > 0 ? -turn : turn;
}

}  // namespace

ActionBumpers::ActionBumpers(std::string name, double back_off_speed, double back_off_time, double turn_time,
                             bool set_maximums)
    : Action(std::move(name)),
      back_off_speed_(back_off_speed),
      back_off_s_(back_off_time / 1000),
      turn_s_(turn_time / 1000),
      sets_maximums_(set_maximums) {}

ActionDesired ActionBumpers::fire(PioneerRobot& robot, const ActionDesired&) {
  const auto front = robot.getBumpDirection(true), rear = robot.getBumpDirection(false);
  constexpr double kRounding_s = 0.0005;
  if (start_s_ && robot.time() - *start_s_ > back_off_s_ + turn_s_ - kRounding_s) start_s_.reset();
  if (!start_s_ && (front || rear)) {
    start_s_ = robot.time();
    direction_ = front ? -1 : 1;
    heading_ = Math::addAngle(robot.getTh(), turnAwayFrom(front ? *front : Math::subAngle(*rear, 180)));
  }
  ActionDesired desired;
  if (!start_s_) return desired;
  if (robot.time() - *start_s_ < back_off_s_ - kRounding_s) {
    const bool blocked = direction_ < 0 ? rear.has_value() : front.has_value();
    desired.setVel(blocked ? 0 : direction_ * back_off_speed_);
    desired.setDeltaHeading(0);
  } else {
    desired.setVel(0);
    desired.setHeading(heading_);
  }
  if (sets_maximums_) {
    desired.setMaxVel(back_off_speed_);
    desired.setMaxNegVel(-back_off_speed_);
  }
  return desired;
}

}  // namespace robosim
