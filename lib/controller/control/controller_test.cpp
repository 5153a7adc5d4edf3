#include "control/controller.h"

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "control/blocking_controller.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

/// Drives a little faster in each step.
class Accelerator : public Controller {
 public:
  void step(Robot& robot) override { robot.drive(0.1 * ++steps_, 0); }
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Accelerator>(*this); }

 private:
  int steps_ = 0;
};

TEST(Controller, CloneContinuesFromTheSameStateOnAnotherRobot) {
  FakeHardware here, there;
  Robot robot(here);
  Accelerator controller;
  for (int i = 0; i < 3; ++i) controller.step(robot);
  const auto copy = cloneController(controller, "accelerator", "fake");
  controller.step(robot);
  controller.step(robot);
  there.command(robot.command());
  Robot fork(there);
  EXPECT_EQ(fork.command(), robot.command());
  copy->step(fork);
  EXPECT_DOUBLE_EQ(here.lastCommand().speed_mps, 0.5);
  EXPECT_DOUBLE_EQ(there.lastCommand().speed_mps, 0.4);
}

TEST(Controller, WithoutCloneIsNamedByTheError) {
  // Its program is in the middle of a loop, on the stack of a thread.
  const BlockingController controller([](Robot&, StepClock& clock) { clock.waitForNextStep(); });
  try {
    cloneController(controller, "loop", "Robo");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "robot 'Robo': its controller loop cannot be copied, so that its run cannot be forked; implement "
                 "Controller::clone(), or use another controller");
  }
}

}  // namespace
}  // namespace robosim
