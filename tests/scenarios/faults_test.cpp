// Failures of robot processes, geometry workers and the recording environment: no other client waits for longer than a
// deadline, the run continues, an absent robot stands still and may reconnect, and one log line reports the fault.
//
// Deadlines use a manual clock. A fault in a test that does not advance the clock has delayed no client; otherwise the
// delay is at most the time advanced.
#include <csignal>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client/network_hardware.h"
#include "net/wire_error.h"
#include "robosim/v1/robots.grpc.pb.h"
#include "tests/scenarios/beside_run.h"
#include "tests/scenarios/fault_proxy.h"
#include "tests/scenarios/manual_clock.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/serving.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

constexpr auto kStepDeadline = 1s;  // serve's default

/// The small maze with both robots in other processes; paused, so that each test controls the steps.
ServedWorld::Options pausedMaze(ManualClock& clock) {
  ServedWorld::Options options;
  options.robots_elsewhere = true;
  options.server.is_paused = true;
  options.server.step_deadline = kStepDeadline;
  options.server.now = [&clock] { return clock.read(); };
  return options;
}

/// Advances the clock to exactly the step deadline: until then the world waits, and the log does not contain
/// `log_line`.
void waitForDeadline(ManualClock& clock, ServedWorld& world, const std::string& log_line) {
  clock.waitForReads();
  clock.advance(kStepDeadline - 1ns);
  clock.waitForReads();
  EXPECT_EQ(countOf(log_line, world.log()), 0u) << "it may still answer\n" << world.log();
  clock.advance(1ns);
  world.waitForLog(log_line);
}

/// Pioneer1 and Scout1 in a process each, at step 10.
struct TwoRobots {
  TwoRobots() { panel.step(10); }
  const mrpt::math::TPose2D& pose(std::size_t robot) const { return world.state().world_from_robot[robot]; }
  std::string lineWith(const std::string& text) const {
    const std::string log = world.log();
    const auto at = log.find(text);
    if (at == std::string::npos) return "";
    const auto begin = log.rfind('\n', at) + 1;
    return log.substr(begin, log.find('\n', at) - begin);
  }
  /// Checks that Pioneer1 stands still, Scout1 drives, and the log has one fault.
  void expectThatOnlyThePioneerStops() {
    panel.step(50);  // until it has stopped
    const auto stopped_at = pose(0), passed_by = pose(1);
    panel.step(20);
    EXPECT_EQ(pose(0), stopped_at);
    EXPECT_NE(pose(1), passed_by);
    EXPECT_EQ(countOf("has left", world.log()) + countOf("disconnected", world.log()), 1u) << world.log();
  }
  /// Checks that Pioneer1 is the third connection, and drives again.
  void expectThatThePioneerComesBack() {
    world.waitForLog("): connected", 3);
    const auto stood_at = pose(0);
    panel.step(20);
    EXPECT_NE(pose(0), stood_at);
    EXPECT_EQ(panel.status().robots_connected(), 2u);
  }

  ManualClock clock;
  ServedWorld world{pausedMaze(clock)};
  std::unique_ptr<StartedProgram> pioneer = startRobots({"Pioneer1"}, world.connectOptions().address);
  std::unique_ptr<StartedProgram> scout = startRobots({"Scout1"}, world.connectOptions().address);
  Panel panel{world};
};

TEST(Faults, KilledRobotProcessStopsItsRobotUntilAnotherProcessConnects) {
  TwoRobots two;
  two.pioneer->signal(SIGKILL);
  two.world.waitForLog("): has left");
  EXPECT_NE(two.lineWith("has left").find("robot Pioneer1 (ipv4:"), std::string::npos);
  two.expectThatOnlyThePioneerStops();
  const auto again = startRobots({"Pioneer1"}, two.world.connectOptions().address);
  two.expectThatThePioneerComesBack();
}

TEST(Faults, FrozenRobotProcessDelaysOneDeadlineAndReconnects) {
  TwoRobots two;
  two.pioneer->signal(SIGSTOP);
  // It may have answered step 10 before it was frozen.
  BesideRun steps(two.world, [&] { return two.panel.step(2); });
  waitForDeadline(two.clock, two.world, "disconnected");
  EXPECT_EQ(steps.get().step(), 12u);
  EXPECT_NE(two.lineWith("disconnected").find("robot Pioneer1 (ipv4:"), std::string::npos) << two.world.log();
  EXPECT_NE(two.lineWith("disconnected").find("within the step deadline of 1000 ms"), std::string::npos);
  two.expectThatOnlyThePioneerStops();
  two.pioneer->signal(SIGCONT);
  two.expectThatThePioneerComesBack();
  two.world.end();
  const Ended ended = two.pioneer->wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(countOf("connected again", ended.err), 1u) << ended.err;
}

TEST(Faults, ConnectionCutWithinAMessageStopsTheRobotUntilItReconnects) {
  ManualClock clock;
  ServedWorld world(pausedMaze(clock));
  FaultProxy line(world.port());
  const auto pioneer = startRobots({"Pioneer1"}, line.address());
  const auto scout = startRobots({"Scout1"}, world.connectOptions().address);
  Panel panel(world);
  panel.step(10);
  line.cutAfter(20);  // fewer than an answer has
  BesideRun step(world, [&] { return panel.step(5); });
  world.waitForLog("): has left");
  world.waitForLog("): connected", 3);
  EXPECT_EQ(step.get().step(), 15u);
  const auto before = world.state().world_from_robot[0];
  panel.step(20);
  EXPECT_NE(world.state().world_from_robot[0], before);
  EXPECT_EQ(countOf("has left", world.log()), 1u) << world.log();
}

TEST(Faults, KilledGeometryWorkerDoesNotChangeTheRun) {
  ManualClock clock;
  ServedWorld::Options options = pausedMaze(clock);
  options.robots_elsewhere = false;
  options.last_step = 100;
  ServedWorld world(options);
  Panel panel(world);
  const auto worker = startWorker(world.connectOptions().address);
  world.waitForLog(": ready");
  panel.step(10);
  worker->signal(SIGSTOP);  // ensures that it holds work when it is killed
  BesideRun step(world, [&] { return panel.step(1); });
  world.waitUntilStepping();
  worker->signal(SIGKILL);
  EXPECT_EQ(step.get().step(), 11u);
  EXPECT_EQ(countOf("geometry worker", world.log()), 2u) << world.log();
  EXPECT_EQ(countOf(": has left", world.log()), 1u);
  panel.start();
  EXPECT_EQ(world.wait(), Served::to_its_end);
  const Ended alone = runProgram("run worlds/small_maze.xml --controller wander --json --time 10");
  EXPECT_EQ(world.digest(), nlohmann::json::parse(alone.out)["digest"].get<std::string>());
}

TEST(Faults, FrozenGeometryWorkerDelaysOneDeadlineAndReconnects) {
  ManualClock clock;
  ServedWorld::Options options = pausedMaze(clock);
  options.robots_elsewhere = false;
  options.last_step = 100;
  ServedWorld world(options);
  Panel panel(world);
  const auto worker = startWorker(world.connectOptions().address);
  world.waitForLog(": ready");
  worker->signal(SIGSTOP);
  BesideRun step(world, [&] { return panel.step(1); });
  waitForDeadline(clock, world, "disconnected: no result within the step deadline");
  EXPECT_EQ(step.get().step(), 1u);
  worker->signal(SIGCONT);
  world.waitForLog(": ready", 2);
  panel.start();
  EXPECT_EQ(world.wait(), Served::to_its_end);
  const Ended alone = runProgram("run worlds/small_maze.xml --controller wander --json --time 10");
  EXPECT_EQ(world.digest(), nlohmann::json::parse(alone.out)["digest"].get<std::string>());
  EXPECT_EQ(worker->wait().exit_code, 0) << worker->error();
}

TEST(Faults, SecondClaimOfARobotIsRefused) {
  TwoRobots two;
  const Ended second = startRobots({"Pioneer1"}, two.world.connectOptions().address)->wait();
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("robot 'Pioneer1' is driven by another process already, at ipv4:"), std::string::npos)
      << second.err;
  EXPECT_EQ(countOf("refused: robot 'Pioneer1' is driven by another process", two.world.log()), 1u);
  const auto before = two.pose(0);
  two.panel.step(20);
  EXPECT_NE(two.pose(0), before);
  EXPECT_EQ(two.panel.status().robots_connected(), 2u);
}

/// A robot process that sends arbitrary messages.
class RawRobot {
 public:
  explicit RawRobot(const ServedWorld& world)
      : stub_(v1::Robots::NewStub(connect(world.connectOptions()))), stream_(stub_->Drive(&context_)) {}
  void hello(const std::string& name, const std::string& world_version = "") {
    v1::DriveRequest message;
    message.mutable_hello()->set_protocol(kProtocolVersion);
    message.mutable_hello()->add_names(name);
    message.mutable_hello()->set_world_version(world_version);
    send(message);
  }
  void send(const v1::DriveRequest& message) { stream_->Write(message); }
  v1::DriveResponse receive() {
    v1::DriveResponse message;
    EXPECT_TRUE(stream_->Read(&message));
    return message;
  }
  grpc::Status finish() {
    for (v1::DriveResponse message; stream_->Read(&message);) {
    }
    return stream_->Finish();
  }

 private:
  std::unique_ptr<v1::Robots::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::DriveRequest, v1::DriveResponse>> stream_;
};

TEST(Faults, CommandForAnotherRobotEndsTheConnection) {
  ManualClock clock;
  ServedWorld world(pausedMaze(clock));
  Panel panel(world);
  RawRobot pioneer(world);
  pioneer.hello("Pioneer1");
  const auto scout = startRobots({"Scout1"}, world.connectOptions().address);
  pioneer.receive();
  v1::DriveRequest message;
  v1::StepAnswer& answer = *message.mutable_answer();
  answer.set_step(pioneer.receive().readings().step());
  auto& order = *answer.add_commands();
  order.set_process_robot(1);  // its process has only robot 0
  order.mutable_command()->set_speed_mps(1);
  pioneer.send(message);
  const grpc::Status status = pioneer.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(status.error_message().find("a command for robot 1 of 1"), std::string::npos) << status.error_message();
  const auto scout_before = world.state().world_from_robot[1];
  panel.step(20);
  EXPECT_NE(world.state().world_from_robot[1], scout_before);
  EXPECT_EQ(world.state().driven_m[0], 0);
  EXPECT_EQ(countOf("disconnected: a command for robot 1 of 1", world.log()), 1u) << world.log();
}

TEST(Faults, RobotsOfAnotherWorldReceiveBothVersions) {
  ManualClock clock;
  ServedWorld world(pausedMaze(clock));
  RawRobot pioneer(world);
  pioneer.hello("Pioneer1", "0123456789abcdef");
  const grpc::Status status = pioneer.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_NE(status.error_message().find("the world version '0123456789abcdef', and the environment has version "),
            std::string::npos)
      << status.error_message();
  world.waitForLog("refused: the robots require the world version");
}

TEST(Faults, AnswerToAnotherStepEndsTheConnection) {
  ManualClock clock;
  ServedWorld world(pausedMaze(clock));
  RawRobot pioneer(world);
  const auto scout = startRobots({"Scout1"}, world.connectOptions().address);
  pioneer.hello("Pioneer1");
  pioneer.receive();
  v1::DriveRequest answer;
  answer.mutable_answer()->set_step(pioneer.receive().readings().step());
  pioneer.send(answer);
  pioneer.send(answer);
  Panel(world).step(2);
  const grpc::Status status = pioneer.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(),
            "an answer to step 0, and the environment awaits that to step 1; answer each step once, after receiving "
            "its readings");
}

TEST(Faults, DelayedEnvironmentDisconnectsNoRobot) {
  ManualClock clock;
  ServedWorld world(pausedMaze(clock));
  RawRobot pioneer(world), scout(world);
  pioneer.hello("Pioneer1");
  scout.hello("Scout1");
  BesideRun step(world, [&] { return Panel(world).step(1); });
  for (RawRobot* robot : {&pioneer, &scout}) {
    robot->receive();
    robot->receive();
  }
  clock.waitForReads();
  clock.block();
  v1::DriveRequest answer;
  answer.mutable_answer()->set_step(0);
  for (RawRobot* robot : {&pioneer, &scout}) robot->send(answer);
  clock.advance(kStepDeadline);
  std::this_thread::sleep_for(2 * ServingState::kPollInterval);  // longer than its polling period
  clock.release();
  EXPECT_EQ(step.get().step(), 1u);
  EXPECT_EQ(countOf("disconnected", world.log()), 0u) << world.log();
}

TEST(Faults, FrozenGeometryWorkerDoesNotPreventTheEndOfTheRun) {
  ManualClock clock;  // not advanced, so that no deadline passes
  ServedWorld::Options options = pausedMaze(clock);
  options.robots_elsewhere = false;
  ServedWorld world(options);
  const auto worker = startWorker(world.connectOptions().address);
  world.waitForLog(": ready");
  worker->signal(SIGSTOP);
  Panel(world).start();
  clock.waitForReads();
  EXPECT_EQ(world.end(), Served::interrupted);
  EXPECT_EQ(countOf("disconnected: the run was interrupted", world.log()), 1u) << world.log();
  worker->signal(SIGCONT);
}

TEST(Faults, SilentClientIsDisconnectedAfterTenSeconds) {
  ManualClock clock;
  ServedWorld world(pausedMaze(clock));
  RawRobot silent(world), wrong_first(world);
  wrong_first.send({});
  EXPECT_EQ(wrong_first.finish().error_message(), "the first message of a robot's process must be its hello");
  // Both calls use one connection, the silent call first. So it has been received, and its deadline has started.
  clock.advance(10s - 1ns);
  clock.waitForReads();
  EXPECT_EQ(countOf("no first message", world.log()), 0u);
  clock.advance(1ns);
  const grpc::Status status = silent.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_EQ(status.error_message(), "no first message within 10000 ms of the call; send it at once, and call again");
}

TEST(Faults, SilentMachineIsDetectedAtBothEnds) {
  ManualClock clock;
  ServedWorld::Options options = pausedMaze(clock);
  constexpr auto kKeepalive = 500ms;  // an answer that takes as long ends a connection that is not silent
  options.server.keepalive = kKeepalive;
  ServedWorld world(options);
  FaultProxy line(world.port());
  ConnectOptions connect_options{.address = line.address()};
  connect_options.keepalive = kKeepalive;
  NetworkHardware pioneer(connect_options, {"Pioneer1"});
  line.stopForwarding();
  world.waitForLog("robot Pioneer1 (ipv4:");
  world.waitForLog("): has left");
  EXPECT_THROW(pioneer.nextStep(), ConnectionError);
}

TEST(Faults, SigtermOfARecordingEnvironmentLeavesAReadableRawlog) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  Serving serving({"--wait-for-robots", "--json", "--record", rawlog.string()});
  const auto robots = startRobots({"Pioneer1", "Scout1"}, serving.address());
  serving.program().waitForError("all robots are connected");
  serving.program().signal(SIGTERM);
  const Ended ended = serving.program().wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(nlohmann::json::parse(ended.out)["ended_by"], "interrupted");
  EXPECT_EQ(countOf("has left", ended.err), 0u) << "it has sent its goodbye";
  const ToolRun tool = runTool("rawlog-edit --info -i run.rawlog", folder);
  EXPECT_EQ(tool.exit_code, 0) << tool.output;
  const Ended notified = robots->wait();
  EXPECT_EQ(notified.exit_code, 0) << notified.err;
  EXPECT_NE(notified.out.find("the run is over after "), std::string::npos);
}

TEST(Faults, KilledEnvironmentEndsItsRobotsAfterTheirReconnectTimeout) {
  Serving serving({"--wait-for-robots"});
  StartedProgram robots(
      {"robot", "Pioneer1", "Scout1", "--environment", serving.address(), "--reconnect-timeout", "0.5"});
  serving.program().waitForError("all robots are connected");
  serving.program().signal(SIGKILL);
  const Ended ended = robots.wait();
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("robosim robot: no environment answers at " + serving.address()), std::string::npos)
      << ended.err;
}

TEST(Faults, NamesWithInvalidUtf8AreReportedBeforeServing) {
  const auto folder = emptyFolder();
  std::string text = textOf(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml");
  std::ofstream(folder / "maze_\xE9.xml", std::ios::binary) << text;
  for (auto at = text.find("Scout1"); at != std::string::npos; at = text.find("Scout1")) {
    text.replace(at, 6, "Pr\xF9zkumn\xEDk");
  }
  std::ofstream(folder / "latin_1.xml", std::ios::binary) << text;
  const std::pair<const char*, const char*> faults[] = {
      {"maze_\xE9.xml", "the name of the world 'maze_?' is not UTF-8"},
      {"latin_1.xml", "latin_1.xml:105: a character is not in the file's encoding"},
  };
  for (const auto& [world, fault] : faults) {
    const Ended ended = runProgram("serve '" + (folder / world).string() + "' --listen :0");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_NE(ended.err.find(fault), std::string::npos) << ended.err;
  }
}

TEST(Realtime, KeepsTheLastCommandOfALateRobotAndCountsLateCommands) {
  Serving serving({"--wait-for-robots", "--json", "--pace", "realtime", "--speed", "20", "--time", "60"});
  const auto pioneer = startRobots({"Pioneer1"}, serving.address());
  const auto scout = startRobots({"Scout1"}, serving.address());
  serving.program().waitForError("all robots are connected");
  pioneer->signal(SIGSTOP);
  const auto summary = nlohmann::json::parse(serving.program().wait().out);
  EXPECT_EQ(summary["steps"], 600);
  EXPECT_GE(summary["late"], 100);
}

}  // namespace
}  // namespace robosim
