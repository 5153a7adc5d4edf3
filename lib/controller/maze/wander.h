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
  explicit Wander(const ControllerSetup& setup) : seed_(setup.seed), robot_(setup.robot), recovery_(setup) {}
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Wander>(*this); }
  bool hasDrawnRandomNumbers() const override { return true; }

 private:
  std::uint64_t seed_;
  std::uint32_t robot_;
  StuckRecovery recovery_;
  std::uint64_t turn_until_ = 0;  ///< step until which it keeps turning
  double turn_ = 0;               ///< fraction of the robot's maximum turn rate, signed
};

}  // namespace robosim
