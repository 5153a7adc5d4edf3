#pragma once
#include "aria/action.h"

namespace robosim {

/// Reacts to the bumpers, as ARIA's ArActionBumpers: after a contact in front the robot backs off, after one behind it
/// drives ahead, each for `back_off_time` [ms], and then turns away from the contact for `turn_time` [ms]. The nearer
/// the contact was to the direction of motion, the larger the turn: 90° for a contact straight ahead, and none for one
/// at the side. While a bumper on the other side is pressed, it stands.
class ActionBumpers : public Action {
 public:
  /// @param set_maximums also limits the speed to `back_off_speed` meanwhile
  explicit ActionBumpers(std::string name = "bumpers", double back_off_speed = 100, double back_off_time = 3000,
                         double turn_time = 3000, bool set_maximums = false);
  ActionDesired fire(PioneerRobot& robot, const ActionDesired&) override;

 private:
  double back_off_speed_, back_off_s_, turn_s_;
  bool sets_maximums_;
  std::optional<double> start_s_;  ///< of the reaction; nullopt while there is none
  double direction_ = -1;          ///< of backing off: 1 ahead, -1 backwards
  double heading_ = 0;             ///< after the turn, in the frame of getPose() [deg]
};

}  // namespace robosim
