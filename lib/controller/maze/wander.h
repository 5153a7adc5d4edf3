#pragma once
#include <cstdint>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/stuck_recovery.h"

namespace robosim {

/// Random walk with obstacle avoidance: drives ahead, turns away from near obstacles, and occasionally turns at random.
/// StuckRecovery handles lack of progress. Detects obstacles by sonar, or by infrared on a robot without sonar. Keeps
/// no map and does not allocate, so that 100,000 instances can run at once.
class Wander : public Controller {
 public:
  explicit Wander(const ControllerSetup& setup) : recovery_(setup) {}
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Wander>(*this); }
  bool hasDrawnRandomNumbers() const override { return true; }

 private:
  StuckRecovery recovery_;
  double turn_ = 0;               ///< fraction of the robot's maximum turn rate, signed
  std::uint32_t turn_until_ = 0;  ///< step until which it keeps turning
};

}  // namespace robosim
