#pragma once
#include <cstdint>

#include "control/controller.h"
#include "maze/controllers.h"

namespace robosim {

/// Drives about at random: ahead, away from what is near, and now and then a turn for no reason. Keeps no map and
/// allocates nothing, so that a hundred thousand of them can run at once.
class Wander : public Controller {
 public:
  explicit Wander(const ControllerSetup& setup) : setup_(setup) {}
  void step(Robot& robot) override;

 private:
  ControllerSetup setup_;
  std::uint64_t turn_until_ = 0;  ///< step until which it keeps turning
  double turn_ = 0;               ///< part of the robot's fastest turn, signed
};

}  // namespace robosim
