// RunOperator, the control of a served run from a window, without the window.
#include "viewing/run_operator.h"

#include <gtest/gtest.h>

#include "tests/scenarios/panel.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/wait.h"

namespace robosim {
namespace {

TEST(RunOperator, StartsWithTheRunsStatus) {
  ServedWorld::Options options = paused();
  options.server.speed = 3;
  ServedWorld world(options);
  const RunOperator run_operator(world.connectOptions());
  EXPECT_TRUE(run_operator.isPaused());
  EXPECT_EQ(run_operator.speed(), 3);
}

TEST(RunOperator, ExecutesOperationsInOrderAndReportsTheRequestedState) {
  ServedWorld world(paused());
  Panel panel(world);
  RunOperator run_operator(world.connectOptions());
  for (int i = 0; i < 5; ++i) run_operator.step();
  run_operator.setSpeed(2);
  EXPECT_EQ(run_operator.speed(), 2);
  run_operator.pause(false);
  EXPECT_FALSE(run_operator.isPaused());
  waitUntil("the run is beyond step 5", [&] { return panel.status().step() > 5; });
  run_operator.pause(true);
  EXPECT_TRUE(run_operator.isPaused());
  waitUntil("the run is paused", [&] { return panel.status().phase() == v1::RUN_PHASE_PAUSED; });
  EXPECT_EQ(panel.status().speed(), 2);
}

TEST(RunOperator, ReceivesChangesByOtherPanels) {
  ServedWorld world(paused());
  Panel panel(world);
  const RunOperator run_operator(world.connectOptions());
  panel.setSpeed(7);
  panel.start();
  const auto seen = [&](bool is_paused) {
    panel.status();  // a round trip
    return run_operator.isPaused() == is_paused && run_operator.speed() == 7;
  };
  waitUntil("the operator knows of the start", [&] { return seen(false); });
  panel.pause();
  waitUntil("the operator knows of the pause", [&] { return seen(true); });
}

TEST(RunOperator, NeverBlocksOnResponses) {
  ServedWorld::Options options = paused();
  options.robots_elsewhere = true;  // never connected, so that no step is taken
  ServedWorld world(options);
  {
    RunOperator run_operator(world.connectOptions());
    run_operator.step();
    world.waitForLog("step");
    EXPECT_TRUE(run_operator.isPaused());
  }
  EXPECT_EQ(Panel(world).status().step(), 0u);
}

TEST(RunOperator, ReportsRefusedOperationsAndContinues) {
  ServedWorld::Options options = paused();
  options.robots_elsewhere = true;
  ServedWorld world(options);
  Panel panel(world);
  testing::internal::CaptureStderr();
  RunOperator run_operator(world.connectOptions());
  run_operator.step();
  world.waitForLog("step");
  panel.pause();
  run_operator.setSpeed(5);
  waitUntil("the speed is 5", [&] { return panel.status().speed() == 5; });
  const std::string output = testing::internal::GetCapturedStderr();
  EXPECT_NE(output.find("robosim view: "), std::string::npos) << output;
  EXPECT_NE(output.find("another control panel has paused the run"), std::string::npos) << output;
}

TEST(RunOperator, PrintsNothingAfterTheEndOfTheRun) {
  ServedWorld world(paused());
  testing::internal::CaptureStderr();
  {
    RunOperator run_operator(world.connectOptions());
    Panel(world).stop();
    EXPECT_EQ(world.wait(), Served::stopped);
    run_operator.pause(false);
    run_operator.setSpeed(1);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace robosim
