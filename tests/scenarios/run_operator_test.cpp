// What a window does to a run that goes on elsewhere, without the window.
#include "robosim/run_operator.h"

#include <thread>

#include <gtest/gtest.h>

#include "tests/scenarios/panel.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

/// Until the environment says so, or for ever: the test's own time limit ends it.
template <typename Condition>
void waitUntil(const Condition& holds) {
  while (!holds()) std::this_thread::yield();
}

TEST(RunOperator, BeginsAsTheRunStands) {
  ServedWorld::Options options = paused();
  options.server.speed = 3;
  ServedWorld world(options);
  const RunOperator run_operator(world.dialOptions());
  EXPECT_TRUE(run_operator.isPaused());
  EXPECT_EQ(run_operator.speed(), 3);
}

TEST(RunOperator, DoesOneThingAfterTheOtherAndTellsAtOnceWhatItWasAskedFor) {
  ServedWorld world(paused());
  Panel panel(world);
  RunOperator run_operator(world.dialOptions());
  for (int i = 0; i < 5; ++i) run_operator.step();
  run_operator.setSpeed(2);
  EXPECT_EQ(run_operator.speed(), 2);
  run_operator.pause(false);
  EXPECT_FALSE(run_operator.isPaused());
  waitUntil([&] { return panel.status().step() > 5; });
  run_operator.pause(true);
  EXPECT_TRUE(run_operator.isPaused());
  waitUntil([&] { return panel.status().phase() == wire::PAUSED; });
  EXPECT_EQ(panel.status().speed(), 2);
}

TEST(RunOperator, LearnsWhatAnotherPanelHasDone) {
  ServedWorld world(paused());
  Panel panel(world);
  const RunOperator run_operator(world.dialOptions());
  panel.setSpeed(7);
  panel.start();
  waitUntil([&] { return !run_operator.isPaused() && run_operator.speed() == 7; });
  panel.pause();
  waitUntil([&] { return run_operator.isPaused(); });
}

TEST(RunOperator, WaitsForNoAnswerNeitherToGoOnNorToEnd) {
  ServedWorld::Options options = paused();
  options.robots_elsewhere = true;  // and never there: no step is ever taken
  ServedWorld world(options);
  {
    RunOperator run_operator(world.dialOptions());
    run_operator.step();
    world.waitForLog("step");
    EXPECT_TRUE(run_operator.isPaused());
  }
  EXPECT_EQ(Panel(world).status().step(), 0u);
}

TEST(RunOperator, TellsWhatTheEnvironmentWillNotDoAndGoesOn) {
  ServedWorld::Options options = paused();
  options.robots_elsewhere = true;
  ServedWorld world(options);
  Panel panel(world);
  testing::internal::CaptureStderr();
  RunOperator run_operator(world.dialOptions());
  run_operator.step();
  world.waitForLog("step");
  panel.pause();
  run_operator.setSpeed(5);
  waitUntil([&] { return panel.status().speed() == 5; });
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("robosim view: "), std::string::npos) << told;
  EXPECT_NE(told.find("another control panel has paused the run"), std::string::npos) << told;
}

TEST(RunOperator, SaysNothingOfARunThatIsOver) {
  ServedWorld world(paused());
  testing::internal::CaptureStderr();
  {
    RunOperator run_operator(world.dialOptions());
    Panel(world).stop();
    EXPECT_EQ(world.wait(), Served::stopped);
    run_operator.pause(false);
    run_operator.setSpeed(1);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace robosim
