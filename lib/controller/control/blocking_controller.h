#pragma once
#include <functional>
#include <memory>

#include "control/controller.h"

namespace robosim {

/// Synchronises a program that runs as a loop with the simulation's steps.
class StepClock {
 public:
  /// Blocks until the next time step, and returns when the new readings are available. When the run ends, it throws an
  /// object that is not a std::exception, in order to unwind the program; do not catch it.
  virtual void waitForNextStep() = 0;

 protected:
  ~StepClock() = default;
};

/// Runs a program written as a loop, the style of ARIA and Nomad programs:
///
///     BlockingController controller([](Robot& robot, StepClock& clock) {
///       while (robot.heat() < 10) {
///         robot.drive(0.3, 0);
///         clock.waitForNextStep();
///       }
///       robot.halt(Activity::found);
///     });
///
/// The program has its own thread, which runs only inside step() while the caller waits. Exactly one of the two threads
/// runs at any time, so that runs are reproducible and no locks are needed. The robot halts when the program returns.
/// An exception from the program stops the robot and is rethrown by step(); later steps do nothing.
class BlockingController : public Controller {
 public:
  using Program = std::function<void(Robot&, StepClock&)>;

  explicit BlockingController(Program program);
  /// Ends a running program by an exception from its wait.
  ~BlockingController() override;

  /// @param robot must be the same in every step: the program keeps a reference.
  void step(Robot& robot) override;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace robosim
