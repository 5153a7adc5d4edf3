#include "aria/stock_actions.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace robosim {
namespace {

/// Clearance [mm] between the robot's edge and the nearest echo between two directions.
double clearanceBetween(const PioneerRobot& robot, double from_deg, double to_deg) {
  return robot.checkRangeDevicesCurrentPolar(from_deg, to_deg) - robot.getRobotRadius();
}

/// The side with more clearance, ignoring echoes straight ahead: 1 left, -1 right.
int clearerSide(const PioneerRobot& robot) {
  return clearanceBetween(robot, 10, 100) >= clearanceBetween(robot, -100, -10) ? 1 : -1;
}

/// Clearance [mm] between the robot's edge and the nearest echo in its lane; `direction` is 1 ahead, -1 backwards.
double clearanceInLane(const PioneerRobot& robot, double direction, double width_ratio) {
  const double radius = robot.getRobotRadius();
  const double reach = 30000;
  return robot.checkRangeDevicesCurrentBox(0, -radius * width_ratio, direction * reach, radius * width_ratio) - radius;
}

/// Speed limit by clearance: 0 up to `stop`, then linear to `slow_speed` at `slow`; 1e9 beyond.
double speedForClearance(double clearance, double stop, double slow, double slow_speed) {
  if (clearance > slow) return 1e9;
  return slow_speed * std::clamp((clearance - stop) / (slow - stop), 0.0, 1.0);
}

}  // namespace

ActionAvoidFront::ActionAvoidFront(std::string name, double obstacle_distance, double avoid_velocity,
                                   double turn_amount)
    : Action(std::move(name)),
      obstacle_distance_(obstacle_distance),
      avoid_velocity_(avoid_velocity),
      turn_amount_(turn_amount) {}

ActionDesired ActionAvoidFront::fire(PioneerRobot& robot, const ActionDesired&) {
  const double left = clearanceBetween(robot, 0, 70), right = clearanceBetween(robot, -70, 0);
  ActionDesired desired;
  if (std::min(left, right) > obstacle_distance_) {
    side_ = 0;
    return desired;
  }
  if (side_ == 0) side_ = left >= right ? 1 : -1;
  const double room = std::min(left, right) / obstacle_distance_;
  desired.setVel(room > 0.5 ? avoid_velocity_ * room : 0);
  desired.setDeltaHeading(side_ * turn_amount_);
  return desired;
}

ActionAvoidSide::ActionAvoidSide(std::string name, double obstacle_distance, double turn_amount)
    : Action(std::move(name)), obstacle_distance_(obstacle_distance), turn_amount_(turn_amount) {}

ActionDesired ActionAvoidSide::fire(PioneerRobot& robot, const ActionDesired&) {
  const bool left = clearanceBetween(robot, 60, 120) < obstacle_distance_;
  const bool right = clearanceBetween(robot, -120, -60) < obstacle_distance_;
  ActionDesired desired;
  if (left != right) desired.setDeltaHeading(left ? -turn_amount_ : turn_amount_);
  return desired;
}

ActionConstantVelocity::ActionConstantVelocity(std::string name, double velocity)
    : Action(std::move(name)), velocity_(velocity) {}

ActionDesired ActionConstantVelocity::fire(PioneerRobot&, const ActionDesired&) {
  ActionDesired desired;
  desired.setVel(velocity_);
  return desired;
}

ActionStallRecover::ActionStallRecover(std::string name, double obstacle_distance, int cycles_to_move, double speed,
                                       double degrees_to_turn)
    : Action(std::move(name)),
      obstacle_distance_(obstacle_distance),
      cycles_to_move_(cycles_to_move),
      speed_(speed),
      degrees_to_turn_(degrees_to_turn) {}

ActionDesired ActionStallRecover::fire(PioneerRobot& robot, const ActionDesired&) {
  ActionDesired desired;
  if (cycles_left_ == 0) {
    if (!robot.isLeftMotorStalled() && !robot.isRightMotorStalled()) return desired;
    cycles_left_ = cycles_to_move_;
    // A stalled robot has no speed, so that the nearer side determines the former direction.
    direction_ = clearanceInLane(robot, 1, 1) <= clearanceInLane(robot, -1, 1) ? -1 : 1;
    heading_ = robot.getTh() + clearerSide(robot) * degrees_to_turn_;
  }
  --cycles_left_;
  desired.setVel(clearanceInLane(robot, direction_, 1) > obstacle_distance_ ? direction_ * speed_ : 0);
  desired.setDeltaHeading(Math::subAngle(heading_, robot.getTh()));
  return desired;
}

ActionGoto::ActionGoto(std::string name, PioneerPose goal, double close_distance, double speed, double speed_to_turn_at,
                       double turn_amount)
    : Action(std::move(name)),
      goal_(goal),
      close_distance_(close_distance),
      speed_(speed),
      speed_to_turn_at_(speed_to_turn_at),
      turn_amount_(turn_amount) {}

void ActionGoto::setGoal(const PioneerPose& goal) {
  goal_ = goal;
  state_ = State::under_way;
}

ActionDesired ActionGoto::fire(PioneerRobot& robot, const ActionDesired&) {
  ActionDesired desired;
  if (state_ != State::under_way) return desired;
  const PioneerPose pose = robot.getPose();
  const double distance = pose.findDistanceTo(goal_);
  if (distance <= close_distance_) {
    state_ = State::achieved;
    return desired;
  }
  const double off = Math::subAngle(pose.findAngleTo(goal_), pose.th);
  // Uses half of the maximum deceleration to stop at the goal's edge.
  double speed = std::min(speed_, std::sqrt(robot.getTransDecel() * (distance - close_distance_)) + 20);
  if (std::abs(off) > 60) {
    speed = 0;
  } else if (std::abs(off) > 10) {
    speed = std::min(speed, speed_to_turn_at_);
  }
  desired.setVel(speed);
  // Beyond 60° it turns by the whole heading error, otherwise by at most turn_amount_ per step.
  desired.setDeltaHeading(std::abs(off) > 60 ? off : std::clamp(off, -turn_amount_, turn_amount_));
  return desired;
}

ActionLimiterForwards::ActionLimiterForwards(std::string name, double stop_distance, double slow_distance,
                                             double slow_speed, double width_ratio)
    : Action(std::move(name)),
      stop_distance_(stop_distance),
      slow_distance_(slow_distance),
      slow_speed_(slow_speed),
      width_ratio_(width_ratio) {}

ActionDesired ActionLimiterForwards::fire(PioneerRobot& robot, const ActionDesired&) {
  ActionDesired desired;
  desired.setMaxVel(
      speedForClearance(clearanceInLane(robot, 1, width_ratio_), stop_distance_, slow_distance_, slow_speed_));
  return desired;
}

ActionLimiterBackwards::ActionLimiterBackwards(std::string name, double stop_distance, double slow_distance,
                                               double max_backwards_speed, double width_ratio)
    : Action(std::move(name)),
      stop_distance_(stop_distance),
      slow_distance_(slow_distance),
      max_backwards_speed_(max_backwards_speed),
      width_ratio_(width_ratio) {}

ActionDesired ActionLimiterBackwards::fire(PioneerRobot& robot, const ActionDesired&) {
  const double allowed = speedForClearance(clearanceInLane(robot, -1, width_ratio_), -stop_distance_, -slow_distance_,
                                           -max_backwards_speed_);
  ActionDesired desired;
  desired.setMaxNegVel(-std::min(allowed, -max_backwards_speed_));
  return desired;
}

ActionTurn::ActionTurn(std::string name, double speed_start_turn_at, double speed_full_turn_at, double turn_amount)
    : Action(std::move(name)),
      speed_start_turn_at_(speed_start_turn_at),
      speed_full_turn_at_(speed_full_turn_at),
      turn_amount_(turn_amount) {}

ActionDesired ActionTurn::fire(PioneerRobot& robot, const ActionDesired& current) {
  ActionDesired desired;
  const double limit = current.getMaxVel();
  if (limit >= speed_start_turn_at_) {
    side_ = 0;
    return desired;
  }
  if (side_ == 0) side_ = clearerSide(robot);
  const double part =
      std::clamp((speed_start_turn_at_ - limit) / (speed_start_turn_at_ - speed_full_turn_at_), 0.0, 1.0);
  desired.setDeltaHeading(side_ * part * turn_amount_);
  return desired;
}

ActionStop::ActionStop(std::string name) : Action(std::move(name)) {}

ActionDesired ActionStop::fire(PioneerRobot&, const ActionDesired&) {
  ActionDesired desired;
  desired.setVel(0);
  desired.setDeltaHeading(0);
  return desired;
}

}  // namespace robosim
