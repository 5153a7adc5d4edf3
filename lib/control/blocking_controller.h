#pragma once
#include <functional>
#include <memory>

#include "control/controller.h"

namespace robosim {

/// What a program that runs as a loop waits on.
class StepClock {
 public:
  /// Lets the simulation take its next time step, and returns with the new readings in place. When the run ends, it
  /// throws something that is no std::exception, so that the program ends: let it pass.
  virtual void waitForNextStep() = 0;

 protected:
  ~StepClock() = default;
};

/// Runs a program that is written as a loop, as ARIA's and the Nomad's users write theirs:
///
///     BlockingController controller([](Robot& robot, StepClock& clock) {
///       while (robot.heat() < 10) {
///         robot.drive(0.3, 0);
///         clock.waitForNextStep();
///       }
///       robot.halt(Activity::found);
///     });
///
/// The program has a thread of its own, which runs only inside step(), while its caller waits: exactly one of the two
/// runs at any moment, so a run is as repeatable as with any other controller, and nothing needs a lock. A program that
/// returns halts its robot. An exception that leaves the program stops the robot and comes out of step(); later steps
/// do nothing.
class BlockingController : public Controller {
 public:
  using Program = std::function<void(Robot&, StepClock&)>;

  explicit BlockingController(Program program);
  /// Ends the program, if it still runs, by an exception out of its wait.
  ~BlockingController() override;

  /// @param robot the same in every step: the program holds on to it.
  void step(Robot& robot) override;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace robosim
