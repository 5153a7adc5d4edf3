#pragma once
#include "aria/action.h"

namespace robosim {

/// Motion that the program sets, as ARIA's ArActionInput: a speed, and a turn speed or a heading. Deactivation and
/// clear() leave both open.
class ActionInput : public Action {
 public:
  explicit ActionInput(std::string name = "input") : Action(std::move(name)) {}
  void setVel(double mm_ps) { vel_ = mm_ps; }
  void setRotVel(double deg_ps);
  void setHeading(double deg);               ///< in the frame of getPose()
  void deltaHeadingFromCurrent(double deg);  ///< relative to the heading of the next step
  void clear();
  void deactivate() override;
  ActionDesired fire(PioneerRobot& robot, const ActionDesired&) override;

 private:
  std::optional<double> vel_, rot_vel_, heading_, delta_;  ///< at most one of the last three
};

}  // namespace robosim
