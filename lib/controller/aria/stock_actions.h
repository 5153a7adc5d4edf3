#pragma once
#include "aria/action.h"
#include "aria/pioneer_robot.h"

namespace robosim {

// ARIA's stock actions, with its names, defaults and units (mm, mm/s, deg), implemented from ARIA's reference
// documentation. Angles are counter-clockwise; distances are from the robot's edge unless stated otherwise.

/// Turns away from obstacles within 70° of straight ahead, and slows down. It keeps its side until the path is free,
/// which prevents oscillation in corners.
class ActionAvoidFront : public Action {
 public:
  explicit ActionAvoidFront(std::string name = "avoid front obstacles", double obstacle_distance = 450,
                            double avoid_velocity = 200, double turn_amount = 15);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double obstacle_distance_, avoid_velocity_, turn_amount_;
  int side_ = 0;  ///< side it turns to: 1 left, -1 right, 0 not turning
};

/// Steers away from obstacles beside the robot (between 60° and 120° to either side).
class ActionAvoidSide : public Action {
 public:
  explicit ActionAvoidSide(std::string name = "avoid side", double obstacle_distance = 300, double turn_amount = 5);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double obstacle_distance_, turn_amount_;
};

/// Drives at a constant speed.
class ActionConstantVelocity : public Action {
 public:
  explicit ActionConstantVelocity(std::string name = "constant velocity", double velocity = 400);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double velocity_;
};

/// Recovers from a stall: reverses for a number of steps, opposite to its former direction, and turns to the side with
/// more free space.
class ActionStallRecover : public Action {
 public:
  /// @param obstacle_distance no reversing towards an obstacle nearer than this.
  explicit ActionStallRecover(std::string name = "stall recover", double obstacle_distance = 225,
                              int cycles_to_move = 50, double speed = 150, double degrees_to_turn = 45);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double obstacle_distance_;
  int cycles_to_move_;
  double speed_, degrees_to_turn_;
  int cycles_left_ = 0;
  double direction_ = -1;  ///< of the recovery: 1 ahead, -1 backwards
  double heading_ = 0;     ///< target, in the frame of getPose() [deg]
};

/// Drives to a goal in the frame of getPose(), and is inactive once the goal is reached.
class ActionGoto : public Action {
 public:
  explicit ActionGoto(std::string name = "goto", PioneerPose goal = {}, double close_distance = 100, double speed = 400,
                      double speed_to_turn_at = 150, double turn_amount = 7);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

  void setGoal(const PioneerPose& goal);
  const PioneerPose& getGoal() const { return goal_; }
  bool haveAchievedGoal() const { return state_ == State::achieved; }
  void cancelGoal() { state_ = State::none; }

 private:
  enum class State { none, under_way, achieved };
  PioneerPose goal_;
  double close_distance_, speed_, speed_to_turn_at_, turn_amount_;
  State state_ = State::under_way;
};

/// Limits the forward speed by the nearest obstacle in the robot's lane: `slow_speed` at `slow_distance`, decreasing
/// linearly to 0 at `stop_distance`.
class ActionLimiterForwards : public Action {
 public:
  /// @param width_ratio the lane's width in robot diameters.
  explicit ActionLimiterForwards(std::string name = "speed limiter", double stop_distance = 250,
                                 double slow_distance = 1000, double slow_speed = 200, double width_ratio = 1);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double stop_distance_, slow_distance_, slow_speed_, width_ratio_;
};

/// The same for backward motion; its distances and speed are negative.
class ActionLimiterBackwards : public Action {
 public:
  explicit ActionLimiterBackwards(std::string name = "backwards speed limiter", double stop_distance = -250,
                                  double slow_distance = -600, double max_backwards_speed = -250,
                                  double width_ratio = 1.5);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double stop_distance_, slow_distance_, max_backwards_speed_, width_ratio_;
};

/// Turns when actions of higher priority have limited the speed: the turn grows from 0 at `speed_start_turn_at` to
/// `turn_amount` at `speed_full_turn_at` and below, to the same side until the limit ends.
class ActionTurn : public Action {
 public:
  explicit ActionTurn(std::string name = "turn", double speed_start_turn_at = 200, double speed_full_turn_at = 100,
                      double turn_amount = 15);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double speed_start_turn_at_, speed_full_turn_at_, turn_amount_;
  int side_ = 0;
};

/// Stands still.
class ActionStop : public Action {
 public:
  explicit ActionStop(std::string name = "stop");
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;
};

}  // namespace robosim
