// The cycle of a PioneerRobot: running, waiting, callbacks, tasks, odometer.
#include <gtest/gtest.h>

#include "aria/key_handler.h"
#include "aria/pioneer_robot.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

struct PioneerCycle : testing::Test {
  FakeHardware hardware;
  Robot robot{hardware};

  /// Runs a program written for ARIA for a number of steps, or until it ends.
  void run(const std::function<void(PioneerRobot&)>& program, int steps = 100) {
    BlockingController controller([&](Robot& r, StepClock& clock) {
      PioneerRobot pioneer(r, clock);
      program(pioneer);
    });
    for (int i = 0; i < steps && robot.activity() == Activity::active; ++i) {
      controller.step(robot);
      hardware.advance();
    }
  }
  double x() const { return hardware.odometry().odom_from_robot.x; }
};

TEST_F(PioneerCycle, SleepsForTheStepsThatTakeAsLong) {
  std::vector<double> times;
  run([&](PioneerRobot& pioneer) {
    for (const double ms : {300.0, 50.0, 0.0, 100.0}) {
      pioneer.sleep(ms);
      times.push_back(pioneer.time());
    }
  });
  ASSERT_EQ(times.size(), 4u);
  EXPECT_NEAR(times[0], 0.3, 1e-9);
  EXPECT_NEAR(times[1], 0.4, 1e-9);
  EXPECT_NEAR(times[2], 0.4, 1e-9);
  EXPECT_NEAR(times[3], 0.5, 1e-9);
}

TEST_F(PioneerCycle, RunsInTheWaitsAfterRunAsync) {
  int cycles = 0;
  run([&](PioneerRobot& pioneer) {
    pioneer.addUserTask("count", 50, [&] { ++cycles; });
    EXPECT_FALSE(pioneer.isRunning());
    pioneer.runAsync(true);
    EXPECT_TRUE(pioneer.isRunning());
    EXPECT_EQ(cycles, 0);
    pioneer.lock();
    pioneer.setVel(200);
    pioneer.unlock();
    pioneer.sleep(1000);
    EXPECT_EQ(cycles, 10);
    EXPECT_NEAR(pioneer.getVel(), 200, 1e-6);
    EXPECT_EQ(pioneer.waitForRunExit(500), PioneerRobot::WAIT_TIMEDOUT);
    EXPECT_EQ(cycles, 15);
    pioneer.stopRunning();
    EXPECT_EQ(pioneer.waitForRunExit(), PioneerRobot::WAIT_RUN_EXIT);
    EXPECT_FALSE(pioneer.isConnected());
  });
  EXPECT_EQ(cycles, 15);
}

TEST_F(PioneerCycle, EndsWhenATaskStopsIt) {
  run([&](PioneerRobot& pioneer) {
    pioneer.addUserTask("stop", 50, [&] {
      if (pioneer.getX() > 300) pioneer.stopRunning();
    });
    pioneer.runAsync();
    pioneer.setVel(400);
    EXPECT_EQ(pioneer.waitForRunExit(), PioneerRobot::WAIT_RUN_EXIT);
    EXPECT_GT(pioneer.getX(), 300);
  });
  EXPECT_EQ(robot.activity(), Activity::halted);
}

TEST_F(PioneerCycle, StopsTheRobotWithoutDisconnecting) {
  bool ran = false;
  run([&](PioneerRobot& pioneer) {
    pioneer.runAsync();
    pioneer.setVel(400);
    pioneer.sleep(1000);
    pioneer.addUserTask("after", 1, [&] { ran = true; });
    pioneer.stopRunning(false);
    EXPECT_TRUE(pioneer.isConnected());
    pioneer.sleep(2000);
    EXPECT_EQ(pioneer.getVel(), 0);
  });
  EXPECT_FALSE(ran);
}

TEST_F(PioneerCycle, CallsBackUponConnectionDisconnectionAndExit) {
  std::string log;
  run([&](PioneerRobot& pioneer) {
    pioneer.addConnectCB([&] { log += "connect "; });
    const int removed = pioneer.addConnectCB([&] { log += "never "; });
    pioneer.addDisconnectNormallyCB([&] { log += "disconnect "; });
    pioneer.addRunExitCB([&] { log += "exit "; });
    EXPECT_TRUE(pioneer.remConnectCB(removed));
    EXPECT_TRUE(pioneer.blockingConnect());
    EXPECT_EQ(pioneer.waitForConnect(), PioneerRobot::WAIT_CONNECTED);
    pioneer.runAsync();
    pioneer.sleep(200);
    log += "stop ";
    pioneer.stopRunning();
    EXPECT_FALSE(pioneer.disconnect());
    EXPECT_FALSE(pioneer.blockingConnect());
    EXPECT_EQ(pioneer.waitForConnect(), PioneerRobot::WAIT_FAILED_CONN);
  });
  EXPECT_EQ(log, "connect stop disconnect exit ");
}

TEST_F(PioneerCycle, ExitsWhenTheRobotHalts) {
  std::string log;
  run([&](PioneerRobot& pioneer) {
    pioneer.addRunExitCB([&] { log += "exit "; });
    pioneer.addSensorInterpTask("halt", 1, [&] {
      if (pioneer.time() > 0.35) robot.halt(Activity::found);
    });
    pioneer.run();
    log += "end";
  });
  EXPECT_EQ(log, "exit end");
  EXPECT_EQ(robot.activity(), Activity::found);
}

/// Logs when it is fired.
class LoggingAction : public Action {
 public:
  explicit LoggingAction(std::string& log) : Action("log"), log_(log) {}
  ActionDesired fire(PioneerRobot&, const ActionDesired&) override {
    log_ += "action ";
    return {};
  }

 private:
  std::string& log_;
};

TEST_F(PioneerCycle, ProcessesSensorsThenActionsThenUserTasks) {
  std::string log;
  PioneerRobot pioneer(robot);
  LoggingAction action(log);
  pioneer.addAction(action, 50);
  EXPECT_TRUE(pioneer.addUserTask("user", 50, [&] { log += "user "; }));
  EXPECT_TRUE(pioneer.addSensorInterpTask("low", 10, [&] { log += "low "; }));
  EXPECT_TRUE(pioneer.addSensorInterpTask("high", 90, [&] { log += "high "; }));
  EXPECT_FALSE(pioneer.addUserTask("user", 70, [] {}));
  hardware.advance();
  pioneer.update();
  EXPECT_EQ(log, "high low action user ");
  EXPECT_TRUE(pioneer.remSensorInterpTask("low"));
  EXPECT_TRUE(pioneer.remUserTask("user"));
  EXPECT_FALSE(pioneer.hasUserTask("user"));
  EXPECT_TRUE(pioneer.hasSensorInterpTask("high"));
  log.clear();
  pioneer.deactivateActions();
  pioneer.update();
  EXPECT_EQ(log, "high ");
}

TEST_F(PioneerCycle, EndsTheRunAtEscape) {
  TextKeys text("..\x1b");
  KeyHandler keys(text);
  double ended_s = 0;
  run([&](PioneerRobot& pioneer) {
    pioneer.attachKeyHandler(keys);
    EXPECT_EQ(pioneer.getKeyHandler(), &keys);
    pioneer.run();
    ended_s = pioneer.time();
  });
  EXPECT_NEAR(ended_s, 0.3, 1e-9);
}

TEST_F(PioneerCycle, MeasuresDistanceAngleAndTime) {
  run([&](PioneerRobot& pioneer) {
    pioneer.move(500);
    while (!pioneer.isMoveDone(0.01)) pioneer.waitForNextStep();
    pioneer.move(-200);
    while (!pioneer.isMoveDone(0.01)) pioneer.waitForNextStep();
    EXPECT_NEAR(pioneer.getOdometerDistance(), 700, 0.1);
    EXPECT_NEAR(pioneer.getX(), 300, 0.1);
    const double before = pioneer.getOdometerTime();
    EXPECT_NEAR(before, pioneer.time(), 1e-9);
    pioneer.resetOdometer();
    pioneer.moveTo({.x = 9000, .y = 0, .th = 45});  // no motion
    pioneer.setDeltaHeading(60);
    while (!pioneer.isHeadingDone(0.01)) pioneer.waitForNextStep();
    pioneer.setDeltaHeading(-60);
    while (!pioneer.isHeadingDone(0.01)) pioneer.waitForNextStep();
    EXPECT_NEAR(pioneer.getOdometerDegrees(), 120, 0.1);
    EXPECT_NEAR(pioneer.getOdometerDistance(), 0, 0.1);
    EXPECT_NEAR(pioneer.getOdometerTime(), pioneer.time() - before, 1e-9);
  });
}

TEST_F(PioneerCycle, ChangesWhenAMotionCountsAsDone) {
  PioneerRobot pioneer(robot);
  pioneer.setMoveDoneDist(5);
  pioneer.setHeadingDoneDiff(10);
  pioneer.move(20);
  pioneer.setDeltaHeading(9);
  EXPECT_FALSE(pioneer.isMoveDone());
  EXPECT_TRUE(pioneer.isHeadingDone());
  EXPECT_FALSE(pioneer.isHeadingDone(8));
}

TEST_F(PioneerCycle, ReturnsToActionsAfterThePrecedenceTime) {
  PioneerRobot pioneer(robot);
  pioneer.setDirectMotionPrecedenceTime(300);
  pioneer.setVel(100);
  const auto step = [&] {
    hardware.advance();
    pioneer.update();
  };
  step();
  step();
  EXPECT_TRUE(pioneer.isDirectMotion());
  step();
  EXPECT_FALSE(pioneer.isDirectMotion());
}

TEST_F(PioneerCycle, GivesTheSameRunEachTime) {
  const auto program = [](PioneerRobot& pioneer) {
    pioneer.runAsync();
    pioneer.addUserTask("swing", 50, [&] { pioneer.setRotVel(pioneer.getTh() > 10 ? -30 : 40); });
    pioneer.setVel(300);
    pioneer.sleep(4000);
    pioneer.stopRunning();
  };
  run(program);
  FakeHardware second;
  Robot other(second);
  BlockingController controller([&](Robot& r, StepClock& clock) {
    PioneerRobot pioneer(r, clock);
    program(pioneer);
  });
  for (int i = 0; i < 100 && other.activity() == Activity::active; ++i) {
    controller.step(other);
    second.advance();
  }
  EXPECT_EQ(second.odometry(), hardware.odometry());
}

}  // namespace
}  // namespace robosim
