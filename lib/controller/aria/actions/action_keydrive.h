#pragma once
#include "aria/action.h"
#include "aria/actions/claimed_keys.h"

namespace robosim {

/// Drives by the arrow keys and the space bar, as ARIA's ArActionKeydrive, through the robot's KeyHandler. Up and down
/// change the speed by an increment, left and right turn in the next step, and space stops. The speed never exceeds the
/// limits of actions of higher priority; after they have determined the speed, it continues from the present one.
class ActionKeydrive : public Action {
 public:
  explicit ActionKeydrive(std::string name = "keydrive", double trans_vel_max = 400, double turn_amount_max = 24,
                          double vel_increment = 25, double turn_increment = 8);
  void setSpeeds(double trans_vel_max, double turn_amount_max);
  void setIncrements(double vel_increment, double turn_increment);
  void setRobot(PioneerRobot* robot) override;
  void deactivate() override;
  ActionDesired fire(PioneerRobot& robot, const ActionDesired& current) override;

  /// @name The keys' functions
  ///@{
  void up() { speed_change_ += vel_increment_; }
  void down() { speed_change_ -= vel_increment_; }
  void left();
  void right();
  void space();
  ///@}

 private:
  double trans_vel_max_, turn_amount_max_, vel_increment_, turn_increment_;
  double speed_ = 0, speed_change_ = 0, turn_ = 0;
  bool was_overruled_ = false;
  ClaimedKeys keys_;
};

}  // namespace robosim
