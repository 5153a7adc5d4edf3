#pragma once
#include "aria/action.h"
#include "aria/actions/claimed_keys.h"
#include "aria/actions/joy_handler.h"
#include "aria/task_list.h"

namespace robosim {

/// Motion in percent of the robot's speeds, as ARIA's ArActionRatioInput. Sources of input, such as RatioInputKeydrive,
/// set the ratios in a callback of each step. Activation sets all ratios to 0.
class ActionRatioInput : public Action {
 public:
  explicit ActionRatioInput(std::string name = "RatioInput") : Action(std::move(name)) {}

  /// @param trans [-100, 100], 100 is full speed ahead, @param rot [-100, 100], 100 is a full turn to the left,
  /// @param throttle [0, 100] scales both. Values outside are clamped.
  void setRatios(double trans, double rot, double throttle);
  void setTransRatio(double trans) { setRatios(trans, rot_, throttle_); }
  void setRotRatio(double rot) { setRatios(trans_, rot, throttle_); }
  void setThrottleRatio(double throttle) { setRatios(trans_, rot_, throttle); }
  double getTransRatio() const { return trans_; }
  double getRotRatio() const { return rot_; }
  double getThrottleRatio() const { return throttle_; }

  /// Speeds [mm/s, deg/s] at full ratios, positive. Between standing and full speed, the turn speed is linear. Without
  /// them, those of the robot's limits apply (getTransVelMax(), getRotVelMax()).
  void setParameters(double full_throttle_forwards, double full_throttle_backwards, double rot_at_full_forwards,
                     double rot_at_full_backwards, double rot_at_stopped);

  /// Callbacks in each step before the ratios are used, the highest priority first. @return false for a known name
  bool addFireCallback(const std::string& name, int priority, Functor functor);
  bool remFireCallback(const std::string& name) { return on_fire_.rem(name); }
  int addActivateCallback(Functor functor, ListPos::Pos position = ListPos::LAST);
  bool remActivateCallback(int number) { return on_activate_.rem(number); }
  int addDeactivateCallback(Functor functor, ListPos::Pos position = ListPos::LAST);
  bool remDeactivateCallback(int number) { return on_deactivate_.rem(number); }

  void activate() override;
  void deactivate() override;
  ActionDesired fire(PioneerRobot& robot, const ActionDesired&) override;

 private:
  struct Speeds {
    double forwards, backwards, rot_at_forwards, rot_at_backwards, rot_at_stopped;
  };
  double trans_ = 0, rot_ = 0, throttle_ = 0;
  std::optional<Speeds> speeds_;
  TaskList on_fire_;
  CallbackList on_activate_, on_deactivate_;
};

/// Arrow keys for an ActionRatioInput, through the robot's KeyHandler: up and down change the speed by an increment
/// [%], left and right turn at half of the turn speed for a step, space stops.
class RatioInputKeydrive {
 public:
  /// @param input must outlive this. Its robot provides the keys.
  explicit RatioInputKeydrive(ActionRatioInput& input, int priority = 25, double vel_increment = 5);
  ~RatioInputKeydrive();
  RatioInputKeydrive(const RatioInputKeydrive&) = delete;
  RatioInputKeydrive& operator=(const RatioInputKeydrive&) = delete;

 private:
  void fire();
  void stop() { trans_ = rot_ = 0; }

  ActionRatioInput& input_;
  double increment_, trans_ = 0, rot_ = 0;
  int on_deactivate_;
  ClaimedKeys keys_;
};

/// A joystick for an ActionRatioInput, while its button 1 or 2 is pressed.
class RatioInputJoydrive {
 public:
  /// @param input, joystick must outlive this, @param stop_if_no_button_pressed stop without a button, instead of
  /// leaving the ratios to other sources of input
  RatioInputJoydrive(ActionRatioInput& input, JoyHandler& joystick, int priority = 50,
                     bool stop_if_no_button_pressed = false);
  ~RatioInputJoydrive();
  RatioInputJoydrive(const RatioInputJoydrive&) = delete;
  RatioInputJoydrive& operator=(const RatioInputJoydrive&) = delete;

 private:
  void fire();

  ActionRatioInput& input_;
  JoyHandler& joystick_;
  bool stops_;
};

}  // namespace robosim
