// The control panel, as a class and from the command line.
#include <csignal>
#include <fstream>
#include <functional>
#include <future>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client/network_hardware.h"
#include "tests/scenarios/manual_clock.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

TEST(ControlPanel, StepsAPausedRunAndWaitsForCompletion) {
  ServedWorld world(paused());
  Panel panel(world);
  EXPECT_EQ(panel.status().phase(), v1::RUN_PHASE_PAUSED);
  EXPECT_EQ(panel.step(1).step(), 1u);
  const v1::RunStatus status = panel.step(30);
  EXPECT_EQ(status.step(), 31u);
  EXPECT_DOUBLE_EQ(status.time_s(), 3.1);
  EXPECT_EQ(status.phase(), v1::RUN_PHASE_PAUSED);
  EXPECT_EQ(panel.status().step(), 31u);
}

TEST(ControlPanel, SteppedRunsEqualContinuousRuns) {
  ServedWorld::Options options = paused();
  options.last_step = 200;
  ServedWorld stepped(options), at_a_stretch(options);
  for (const int n : {1, 2, 50, 100}) Panel(stepped).step(static_cast<std::uint64_t>(n));
  Panel(stepped).start();
  Panel(at_a_stretch).start();
  EXPECT_EQ(stepped.wait(), Served::to_its_end);
  EXPECT_EQ(at_a_stretch.wait(), Served::to_its_end);
  EXPECT_EQ(stepped.digest(), at_a_stretch.digest());
}

TEST(ControlPanel, StartsPausesAndStops) {
  ServedWorld world(paused());
  Panel panel(world);
  EXPECT_EQ(panel.start().phase(), v1::RUN_PHASE_RUNNING);
  while (panel.status().step() < 10) {
  }
  const v1::RunStatus still = panel.pause();
  EXPECT_EQ(still.phase(), v1::RUN_PHASE_PAUSED);
  EXPECT_EQ(panel.status().step(), still.step());
  panel.stop();
  EXPECT_EQ(world.wait(), Served::stopped);
}

TEST(ControlPanel, ReportsAPauseByAnotherPanelToAWaitingStepCall) {
  ServedWorld::Options options = paused();
  options.server.speed = 1;  // a step takes 0.1 s, which leaves time for the other panel
  ServedWorld world(options);
  auto waiting = std::async(std::launch::async, [&] { Panel(world).step(1'000'000); });
  world.waitForLog(": step");
  Panel(world).pause();
  try {
    waiting.get();
    ADD_FAILURE();
  } catch (const ConnectionError& error) {
    EXPECT_EQ(error.code(), grpc::StatusCode::ABORTED);
    EXPECT_NE(std::string(error.what()).find("another control panel has paused the run"), std::string::npos);
  }
}

TEST(ControlPanel, CancelsPendingAndLaterCallsOnDisconnect) {
  ServedWorld::Options options = paused();
  options.robots_elsewhere = true;  // never connected, so that no step is completed
  ServedWorld world(options);
  Panel panel(world);
  const auto code_of = [](const std::function<void()>& call) {
    try {
      call();
    } catch (const ConnectionError& error) {
      return error.code();
    }
    return grpc::StatusCode::OK;
  };
  auto waiting = std::async(std::launch::async, [&] { return code_of([&] { panel.step(1); }); });
  world.waitForLog(": step");
  panel.leave();
  EXPECT_EQ(waiting.get(), grpc::StatusCode::CANCELLED);
  EXPECT_EQ(code_of([&] { panel.status(); }), grpc::StatusCode::CANCELLED);
}

TEST(ConnectionError, DescribesAClosedConnection) {
  const ConnectionError error({grpc::StatusCode::CANCELLED, "CANCELLED"}, {.address = "lab:3000"});
  EXPECT_STREQ(error.what(),
               "the environment at lab:3000 closed the connection before it responded; its run may have ended");
}

TEST(ControlPanel, LoadsAnotherWorldPausedAndKeepsTheCurrentOneOnErrors) {
  ServedWorld world(paused());
  Panel panel(world);
  panel.step(5);
  EXPECT_THROW(panel.load(WorldSource{"x.xml", "<a>", {}, {}}), ConnectionError);
  EXPECT_EQ(panel.status().step(), 5u);
  const v1::RunStatus status = panel.load("worlds/open_100.xml");
  EXPECT_EQ(status.world(), "open_100");
  EXPECT_EQ(status.robots(), 100u);
  EXPECT_EQ(status.step(), 0u);
  EXPECT_EQ(status.phase(), v1::RUN_PHASE_PAUSED);
  EXPECT_EQ(panel.step(2).step(), 2u);
}

TEST(ControlPanel, ReportsAbsentRobots) {
  ServedWorld::Options options;
  options.robots_elsewhere = true;
  ServedWorld world(options);
  Panel panel(world);
  const NetworkHardware robot(world.connectOptions(), {"Scout1"});
  const v1::RunStatus status = panel.status();
  EXPECT_EQ(status.phase(), v1::RUN_PHASE_WAITING);
  EXPECT_EQ(status.robots_connected(), 1u);
  ASSERT_EQ(status.robots_absent_size(), 1);
  EXPECT_EQ(status.robots_absent(0), "Pioneer1");
}

TEST(ControlPanel, StreamsStatusReportsUntilTheRunIsOver) {
  ServedWorld world(paused());
  Panel panel(world);
  std::vector<v1::RunStatus> reports;
  bool is_stopped = false;
  Panel(world).watch(0s, [&](const v1::RunStatus& status) {
    reports.push_back(status);
    if (reports.size() == 1) panel.step(3);
    if (status.step() == 3 && !std::exchange(is_stopped, true)) panel.stop();
  });
  ASSERT_GE(reports.size(), 3u);
  EXPECT_EQ(reports.front().step(), 0u);
  EXPECT_EQ(reports.back().step(), 3u);
  EXPECT_EQ(reports.back().phase(), v1::RUN_PHASE_ENDED);
}

TEST(ControlPanel, SendsStatusReportsAtTheRequestedInterval) {
  ManualClock clock;
  ServedWorld::Options options = paused();
  options.server.now = [&clock] { return clock.read(); };
  ServedWorld world(options);
  Panel panel(world);
  std::size_t reports = 0;
  auto watching = std::async(std::launch::async, [&] {
    Panel(world).watch(10s, [&](const v1::RunStatus& status) {
      ++reports;
      if (status.step() == 0) {
        panel.step(5);
        clock.advance(10s);
      } else if (status.phase() != v1::RUN_PHASE_ENDED) {
        EXPECT_EQ(status.step(), 5u) << "no report before 10 s";
        panel.stop();
      }
    });
  });
  watching.get();
  EXPECT_EQ(reports, 3u);
}

TEST(ControlPanel, SendsStatusReportsAtMostEvery50ms) {
  ManualClock clock;
  ServedWorld::Options options = paused();
  options.server.now = [&clock] { return clock.read(); };
  ServedWorld world(options);
  Panel panel(world);
  std::vector<std::uint64_t> steps;
  Panel(world).watch(0s, [&](const v1::RunStatus& status) {
    steps.push_back(status.step());
    if (steps.size() > 1) {
      if (steps.size() == 2) panel.stop();
      return;
    }
    panel.step(5);
    clock.advance(50ms - 1ns);
    panel.step(5);
    clock.advance(1ns);
  });
  ASSERT_GE(steps.size(), 2u);
  EXPECT_EQ(steps[0], 0u);
  EXPECT_EQ(steps[1], 10u) << "no report of step 5 before 50 ms";
}

TEST(ControlPanel, RejectsAnInvalidInterval) {
  ServedWorld world(paused());
  for (const auto interval : {-1s, 3601s}) {
    try {
      Panel(world).watch(interval, [](const v1::RunStatus&) {});
      ADD_FAILURE();
    } catch (const ConnectionError& error) {
      EXPECT_EQ(error.code(), grpc::StatusCode::INVALID_ARGUMENT);
      EXPECT_EQ(error.reason(), v1::ERROR_REASON_INVALID_MESSAGE);
    }
  }
}

TEST(Control, ControlsARunFromTheCommandLine) {
  Serving serving({"--paused", "--controller", "wander", "--json"});
  const auto control = [&](const std::string& what) {
    const Ended ended = runProgram("control " + serving.address() + " " + what);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended.out;
  };
  EXPECT_NE(control("status").find("paused at step 0"), std::string::npos);
  EXPECT_NE(control("step 12").find("step 12 (1.2 s): paused"), std::string::npos);
  EXPECT_NE(control("load worlds/opho2_1.xml").find("step 0 (0.0 s): paused"), std::string::npos);
  EXPECT_NE(control("status").find("opho2_1"), std::string::npos);
  control("speed 5");
  EXPECT_NE(control("start").find("running"), std::string::npos);
  StartedProgram watch({"control", serving.address(), "status", "--watch", "--interval", "0.05"});
  watch.waitForOutput("running");
  control("stop");
  const Ended watched = watch.wait();
  EXPECT_EQ(watched.exit_code, 0) << watched.err;
  const std::string last_line = watched.out.substr(watched.out.rfind("\nstep"));
  EXPECT_NE(last_line.find(": ended"), std::string::npos) << watched.out;
  const Ended served = serving.program().wait();
  EXPECT_EQ(served.exit_code, 0) << served.err;
  EXPECT_NE(served.out.find("\"ended_by\": \"control_panel\""), std::string::npos) << served.out;
}

TEST(Control, ASignalAfterTheSummaryDoesNotChangeTheExitCode) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Serving serving({"--controller", "still", "--time", "0.1"});
    serving.program().waitForOutput("simulated ");
    serving.program().signal(signal);
    const Ended ended = serving.program().wait();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  }
}

TEST(Control, EndsTheRunIfItsRecordingFailsDuringALoad) {
  const auto folder = emptyFolder();
  Serving serving({"--record", (folder / "run.rawlog").string(), "--paused", "--controller", "wander"});
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  const Ended load = runProgram("control " + serving.address() + " load worlds/opho2_1.xml");
  EXPECT_NE(load.exit_code, 0);
  EXPECT_NE(load.err.find("the run ends here: "), std::string::npos) << load.err;
  const Ended served = serving.program().wait();
  EXPECT_EQ(served.exit_code, 2);
  EXPECT_NE(served.err.find("run.rawlog"), std::string::npos) << served.err;
}

TEST(Control, ContinuesARunWhenAnObserverThrowsAtTheStartOfTheNext) {
  const auto folder = emptyFolder();
  const auto large = folder / "large.xml";
  std::ofstream(large)
      << "<world><surface><size><xmin>-200</xmin><xmax>200</xmax><ymin>-200</ymin><ymax>200</ymax></size>"
         "<object><shape><robot><model>pioneer3dx</model><name>R1</name><x>0</x><y>0</y></robot></shape>"
         "</object></surface></world>";
  Serving serving({"--paused", "--controller", "wander", "--observer", "coverage cell_m=0.01"});
  const Ended load = runProgram("control " + serving.address() + " load '" + large.string() + "'");
  EXPECT_NE(load.exit_code, 0);
  EXPECT_NE(load.err.find("observer 'coverage cell_m=0.01' threw an exception: the surface has more than 100 million"),
            std::string::npos)
      << load.err;
  const Ended step = runProgram("control " + serving.address() + " step 3");
  EXPECT_NE(step.out.find("step 3 (0.3 s): paused"), std::string::npos) << step.out << step.err;
  runProgram("control " + serving.address() + " stop");
  EXPECT_EQ(serving.program().wait().exit_code, 0);
}

TEST(Control, NumbersTheRecordingsOfLaterRuns) {
  const auto folder = emptyFolder();
  Serving serving({"--paused", "--record", (folder / "run.rawlog").string()});
  runProgram("control " + serving.address() + " step 3");
  runProgram("control " + serving.address() + " load worlds/opho2_1.xml");
  runProgram("control " + serving.address() + " step 3");
  runProgram("control " + serving.address() + " stop");
  EXPECT_EQ(serving.program().wait().exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "run.rawlog"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run_2.rawlog"));
}

}  // namespace
}  // namespace robosim
