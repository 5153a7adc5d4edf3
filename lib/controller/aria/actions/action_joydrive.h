#pragma once
#include "aria/action.h"
#include "aria/actions/joy_handler.h"

namespace robosim {

/// Drives by a joystick while its button 1 or 2 is pressed, as ARIA's ArActionJoydrive: ahead by `trans_vel_max`
/// [mm/s], to the side by `turn_amount_max` [deg] per step.
class ActionJoydrive : public Action {
 public:
  /// @param joystick must outlive this; null for none, @param stop_if_no_button_pressed stop without a button, instead
  /// of leaving the motion to other actions
  explicit ActionJoydrive(JoyHandler* joystick, std::string name = "joydrive", double trans_vel_max = 400,
                          double turn_amount_max = 15, bool stop_if_no_button_pressed = true);
  bool joystickInited() const { return joystick_ && joystick_->haveJoystick(); }
  void setSpeeds(double trans_vel_max, double turn_amount_max);
  void setStopIfNoButtonPressed(bool stop) { stops_ = stop; }
  bool getStopIfNoButtonPressed() const { return stops_; }
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override;

 private:
  JoyHandler* joystick_;
  double trans_vel_max_, turn_amount_max_;
  bool stops_;
};

}  // namespace robosim
