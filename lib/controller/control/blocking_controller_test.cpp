#include "control/blocking_controller.h"

#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

TEST(BlockingController, RunsOneLoopIterationPerStep) {
  FakeHardware hardware;
  Robot robot(hardware);
  std::vector<std::uint64_t> seen;
  BlockingController controller([&](Robot& r, StepClock& clock) {
    for (;;) {
      seen.push_back(r.stepNumber());
      clock.waitForNextStep();
    }
  });
  for (int i = 0; i < 4; ++i) {
    controller.step(robot);
    hardware.advance();
  }
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{0, 1, 2, 3}));
}

TEST(BlockingController, RunsTheProgramOnlyInsideAStep) {
  FakeHardware hardware;
  Robot robot(hardware);
  bool inside = false;
  int outside = 0;
  BlockingController controller([&](Robot&, StepClock& clock) {
    for (;;) {
      for (int i = 0; i < 100; ++i) {
        if (!inside) ++outside;
        std::this_thread::yield();
      }
      clock.waitForNextStep();
    }
  });
  for (int i = 0; i < 200; ++i) {
    inside = true;
    controller.step(robot);
    inside = false;
    std::this_thread::yield();
  }
  EXPECT_EQ(outside, 0);
}

TEST(BlockingController, DoesNothingBeforeItsFirstStep) {
  bool ran = false;
  {
    BlockingController controller([&](Robot&, StepClock&) { ran = true; });
  }
  EXPECT_FALSE(ran);
}

TEST(BlockingController, UnwindsTheProgramWhenTheRunEnds) {
  struct Note {
    bool& noted;
    ~Note() { noted = true; }
  };
  FakeHardware hardware;
  Robot robot(hardware);
  bool unwound = false, caught_as_error = false;
  {
    BlockingController controller([&](Robot&, StepClock& clock) {
      const Note note{unwound};
      try {
        for (;;) clock.waitForNextStep();
      } catch (const std::exception&) {
        caught_as_error = true;
      }
    });
    controller.step(robot);
    EXPECT_FALSE(unwound);
  }
  EXPECT_TRUE(unwound);
  EXPECT_FALSE(caught_as_error);
  EXPECT_EQ(robot.activity(), Activity::active);  // the run's end is not the robot's doing
}

TEST(BlockingController, EndsAProgramThatWaitsAgainWhileUnwinding) {
  FakeHardware hardware;
  Robot robot(hardware);
  int waits = 0;
  {
    BlockingController controller([&](Robot&, StepClock& clock) {
      try {
        for (;;) clock.waitForNextStep();
      } catch (...) {
        ++waits;
        clock.waitForNextStep();
        ++waits;
      }
    });
    controller.step(robot);
  }
  EXPECT_EQ(waits, 1);
}

TEST(BlockingController, RethrowsTheProgramsExceptionFromStep) {
  FakeHardware hardware;
  Robot robot(hardware);
  BlockingController controller([](Robot& r, StepClock& clock) {
    r.drive(1, 0);
    clock.waitForNextStep();
    throw std::runtime_error("lost my way");
  });
  controller.step(robot);
  EXPECT_EQ(hardware.lastCommand().speed_mps, 1);
  EXPECT_THROW(controller.step(robot), std::runtime_error);
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0);
  EXPECT_NO_THROW(controller.step(robot));
}

TEST(BlockingController, HaltsTheRobotWhenTheProgramReturns) {
  FakeHardware hardware;
  Robot robot(hardware);
  BlockingController controller([](Robot& r, StepClock& clock) {
    r.drive(1, 0);
    clock.waitForNextStep();
  });
  controller.step(robot);
  EXPECT_EQ(robot.activity(), Activity::active);
  controller.step(robot);
  EXPECT_EQ(robot.activity(), Activity::halted);
}

TEST(BlockingController, KeepsTheFoundActivityWhenTheProgramReturns) {
  FakeHardware hardware;
  Robot robot(hardware);
  BlockingController controller([](Robot& r, StepClock&) { r.halt(Activity::found); });
  controller.step(robot);
  EXPECT_EQ(robot.activity(), Activity::found);
}

}  // namespace
}  // namespace robosim
