#pragma once
#include <memory>
#include <string>

#include "control/robot.h"

namespace robosim {

/// Control program of one robot.
class Controller {
 public:
  virtual ~Controller() = default;
  /// Called once per time step, after sensing: reads the robot's sensors and commands it. Accesses only its own robot,
  /// so that controllers of different robots may run in any order and in parallel.
  virtual void step(Robot& robot) = 0;
  /// A copy that continues independently from the same state, for a fork of the run; it is then called with the fork's
  /// robot. Null, the default, for a controller that cannot be copied, whose run cannot be forked.
  virtual std::unique_ptr<Controller> clone() const { return nullptr; }
  /// Whether any command so far depended on a random number, and thus on the run's seed.
  virtual bool hasDrawnRandomNumbers() const { return false; }
};

/// The controller's clone(), for a fork.
/// @param name of the controller, @param robot name of its robot, for the error
/// @throws ConfigError naming both when the controller cannot be copied
std::unique_ptr<Controller> cloneController(const Controller& controller, const std::string& name,
                                            const std::string& robot);

}  // namespace robosim
