#pragma once
#include "control/robot.h"

namespace robosim {

/// The program of one robot.
class Controller {
 public:
  virtual ~Controller() = default;
  /// Called once a time step, after sensing: read the robot, decide, command. Touches nothing but its own robot, so
  /// controllers of different robots run in any order and in parallel.
  virtual void step(Robot& robot) = 0;
};

}  // namespace robosim
