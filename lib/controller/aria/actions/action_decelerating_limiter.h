#pragma once
#include "aria/action.h"

namespace robosim {

/// Limits the speed so that the robot can stop before the nearest obstacle in its lane, and raises its deceleration
/// when that is necessary, as ARIA's ArActionDeceleratingLimiter. Lane and padding widen with the speed: below
/// `slow_speed` they are those at slow speed, above `fast_speed` those at fast speed, and linear between. The speed is
/// 0 within `clearance` of an obstacle; within the padding beyond it, at most `slow_speed`.
class ActionDeceleratingLimiter : public Action {
 public:
  /// In mm, mm/s and mm/s²; distances are from the robot's edge.
  struct Parameters {
    double clearance = 100;
    double side_clearance_at_slow_speed = 50;
    double padding_at_slow_speed = 50;
    double slow_speed = 200;
    double side_clearance_at_fast_speed = 400;
    double padding_at_fast_speed = 300;
    double fast_speed = 1000;
    double preferred_decel = 600;
    bool use_estop = false;          ///< within the clearance, brake as hard as the hardware allows
    double max_emergency_decel = 0;  ///< limit of the deceleration otherwise; 0 for that of the hardware
  };

  explicit ActionDeceleratingLimiter(std::string name = "limitAndDecel", bool forwards = true);
  void setParameters(const Parameters& parameters) { parameters_ = parameters; }
  const Parameters& parameters() const { return parameters_; }
  bool getForwards() const { return forwards_; }
  void setForwards(bool forwards) { forwards_ = forwards; }
  ActionDesired fire(PioneerRobot& robot, const ActionDesired&) override;

 private:
  Parameters parameters_;
  bool forwards_;
};

}  // namespace robosim
