#pragma once
#include "control/action.h"
#include "control/pioneer_robot.h"

namespace robosim {

// ARIA's stock actions, with its names, defaults and units (mm, mm/s, deg). What each does is written anew from what
// ARIA's reference says it does. Angles are counter-clockwise; distances without another word are from the robot's
// edge.

/// Turns away from what stands within 70° of straight ahead, and slows down for it. It goes on turning to the side it
/// began with until the way is free, so that it does not dither in a corner.
class ActionAvoidFront : public Action {
 public:
  explicit ActionAvoidFront(std::string name = "avoid front obstacles", double obstacle_distance = 450,
                            double avoid_velocity = 200, double turn_amount = 15);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double obstacle_distance_, avoid_velocity_, turn_amount_;
  int side_ = 0;  ///< it turns to: 1 left, -1 right, 0 not turning
};

/// Edges away from what stands beside the robot (between 60° and 120° to either side).
class ActionAvoidSide : public Action {
 public:
  explicit ActionAvoidSide(std::string name = "avoid side", double obstacle_distance = 300, double turn_amount = 5);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double obstacle_distance_, turn_amount_;
};

/// Drives at one speed.
class ActionConstantVelocity : public Action {
 public:
  explicit ActionConstantVelocity(std::string name = "constant velocity", double velocity = 400);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double velocity_;
};

/// After a stall: draws back for a number of steps, away from where it was heading, and turns to the side with more
/// room.
class ActionStallRecover : public Action {
 public:
  /// @param obstacle_distance does not draw back against something as near as this.
  explicit ActionStallRecover(std::string name = "stall recover", double obstacle_distance = 225,
                              int cycles_to_move = 50, double speed = 150, double degrees_to_turn = 45);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double obstacle_distance_;
  int cycles_to_move_;
  double speed_, degrees_to_turn_;
  int cycles_left_ = 0;
  double direction_ = -1;  ///< it draws back in: 1 ahead, -1 backwards
  double heading_ = 0;     ///< it turns to, in the frame of getPose() [deg]
};

/// Drives to a goal in the frame of getPose(), and has nothing to say once it is there.
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

/// Limits the speed ahead by what stands in the robot's lane: `slow_speed` at `slow_distance`, less the nearer it is, 0
/// from `stop_distance` on.
class ActionLimiterForwards : public Action {
 public:
  /// @param width_ratio the lane's width in robot diameters.
  explicit ActionLimiterForwards(std::string name = "speed limiter", double stop_distance = 250,
                                 double slow_distance = 1000, double slow_speed = 200, double width_ratio = 1);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double stop_distance_, slow_distance_, slow_speed_, width_ratio_;
};

/// The same backwards; its distances and speed are negative.
class ActionLimiterBackwards : public Action {
 public:
  explicit ActionLimiterBackwards(std::string name = "backwards speed limiter", double stop_distance = -250,
                                  double slow_distance = -600, double max_backwards_speed = -250,
                                  double width_ratio = 1.5);
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  double stop_distance_, slow_distance_, max_backwards_speed_, width_ratio_;
};

/// Turns when actions of higher priority have limited the speed: from `speed_start_turn_at` down a little, from
/// `speed_full_turn_at` down by `turn_amount`, always to one side until the limit is gone.
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
