// What may go wrong with robots' processes, geometry workers and the recording environment: nobody else is held up for
// longer than a deadline, the run goes on, whoever is absent stands still and may come back, and one line tells of it.
//
// The deadlines are told by a clock that stands until the test moves it. So wherever it is not moved, a fault has held
// up nobody; and where it is, for no longer than by that much.
#include <csignal>
#include <fstream>
#include <future>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "control/network_hardware.h"
#include "net/robots.grpc.pb.h"
#include "net/wire_error.h"
#include "tests/scenarios/cut_line.h"
#include "tests/scenarios/hand_clock.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/serving.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

constexpr auto kStepDeadline = 1s;  // serve's default

/// The small maze, whose two robots are elsewhere; paused, so that each test says when a step is taken.
ServedWorld::Options pausedMaze(HandClock& clock) {
  ServedWorld::Options options;
  options.robots_elsewhere = true;
  options.server.is_paused = true;
  options.server.step_deadline = kStepDeadline;
  options.server.now = [&clock] { return clock.read(); };
  return options;
}

/// Has the clock come to the step deadline, and no further: until then the world waits, and `tells` nothing.
void waitOutTheDeadline(HandClock& clock, ServedWorld& world, const std::string& tells) {
  clock.waitUntilSeen();
  clock.advance(kStepDeadline - 1ns);
  clock.waitUntilSeen();
  EXPECT_EQ(countOf(tells, world.log()), 0u) << "it may still answer\n" << world.log();
  clock.advance(1ns);
  world.waitForLog(tells);
}

/// Pioneer1 and Scout1 in a process each, at their tenth step.
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
  /// Pioneer1 stands, Scout1 drives on, and the log has told of one fault only.
  void expectThatOnlyThePioneerStops() {
    panel.step(50);  // it slows down first
    const auto stopped_at = pose(0), passed_by = pose(1);
    panel.step(20);
    EXPECT_EQ(pose(0), stopped_at);
    EXPECT_NE(pose(1), passed_by);
    EXPECT_EQ(countOf("has left", world.log()) + countOf("hung up on", world.log()), 1u) << world.log();
  }
  /// Pioneer1 is the third to connect, and drives again.
  void expectThatThePioneerComesBack() {
    world.waitForLog("): connected", 3);
    const auto stood_at = pose(0);
    panel.step(20);
    EXPECT_NE(pose(0), stood_at);
    EXPECT_EQ(panel.status().robots_connected(), 2u);
  }

  HandClock clock;
  ServedWorld world{pausedMaze(clock)};
  std::unique_ptr<StartedProgram> pioneer = startRobots({"Pioneer1"}, world.dialOptions().address);
  std::unique_ptr<StartedProgram> scout = startRobots({"Scout1"}, world.dialOptions().address);
  Panel panel{world};
};

TEST(Faults, OfARobotsProcessKilledStopItsRobotAndItComesBackInAnotherProcess) {
  TwoRobots two;
  two.pioneer->signal(SIGKILL);
  two.world.waitForLog("): has left");
  EXPECT_NE(two.lineWith("has left").find("robot Pioneer1 (ipv4:"), std::string::npos);
  two.expectThatOnlyThePioneerStops();
  const auto again = startRobots({"Pioneer1"}, two.world.dialOptions().address);
  two.expectThatThePioneerComesBack();
}

TEST(Faults, OfARobotsProcessFrozenCostOneDeadlineAndItComesBackByItselfWhenItThaws) {
  TwoRobots two;
  two.pioneer->signal(SIGSTOP);
  // It may have answered the tenth step before it froze, and cannot answer both.
  auto steps = std::async(std::launch::async, [&] { return two.panel.step(2); });
  waitOutTheDeadline(two.clock, two.world, "hung up on");
  EXPECT_EQ(steps.get().step(), 12u);
  EXPECT_NE(two.lineWith("hung up on").find("robot Pioneer1 (ipv4:"), std::string::npos) << two.world.log();
  EXPECT_NE(two.lineWith("hung up on").find("within the step deadline of 1000 ms"), std::string::npos);
  two.expectThatOnlyThePioneerStops();
  two.pioneer->signal(SIGCONT);
  two.expectThatThePioneerComesBack();
  two.world.end();
  const Ended ended = two.pioneer->wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(countOf("connected again", ended.err), 1u) << ended.err;
}

TEST(Faults, OfAConnectionCutOffMidMessageStopTheRobotAndItComesBackOverAnotherConnection) {
  HandClock clock;
  ServedWorld world(pausedMaze(clock));
  CutLine line(world.port());
  const auto pioneer = startRobots({"Pioneer1"}, line.address());
  const auto scout = startRobots({"Scout1"}, world.dialOptions().address);
  Panel panel(world);
  panel.step(10);
  line.cutAfter(20);  // bytes from the robot: an answer has more
  auto step = std::async(std::launch::async, [&] { return panel.step(5); });
  world.waitForLog("): has left");
  world.waitForLog("): connected", 3);
  EXPECT_EQ(step.get().step(), 15u);
  const auto before = world.state().world_from_robot[0];
  panel.step(20);
  EXPECT_NE(world.state().world_from_robot[0], before);
  EXPECT_EQ(countOf("has left", world.log()), 1u) << world.log();
}

TEST(Faults, OfAGeometryWorkerKilledWhileItHoldsWorkChangeNothingInTheRun) {
  HandClock clock;
  ServedWorld::Options options = pausedMaze(clock);
  options.robots_elsewhere = false;
  options.last_step = 100;
  ServedWorld world(options);
  Panel panel(world);
  const auto worker = startWorker(world.dialOptions().address);
  world.waitForLog(": ready");
  panel.step(10);
  worker->signal(SIGSTOP);  // so that it is sure to hold its share when it dies
  auto step = std::async(std::launch::async, [&] { return panel.step(1); });
  while (!world.isStepping()) std::this_thread::yield();
  worker->signal(SIGKILL);
  EXPECT_EQ(step.get().step(), 11u);
  EXPECT_EQ(countOf("geometry worker", world.log()), 2u) << world.log();
  EXPECT_EQ(countOf(": has left", world.log()), 1u);
  panel.start();
  EXPECT_EQ(world.wait(), Served::to_its_end);
  const Ended alone = runProgram("run worlds/small_maze.xml --controller wander --json --time 10");
  EXPECT_EQ(world.digest(), nlohmann::json::parse(alone.out)["digest"]);
}

TEST(Faults, OfAGeometryWorkerFrozenCostOneDeadlineAndItComesBackByItselfWhenItThaws) {
  HandClock clock;
  ServedWorld::Options options = pausedMaze(clock);
  options.robots_elsewhere = false;
  options.last_step = 100;
  ServedWorld world(options);
  Panel panel(world);
  const auto worker = startWorker(world.dialOptions().address);
  world.waitForLog(": ready");
  worker->signal(SIGSTOP);
  auto step = std::async(std::launch::async, [&] { return panel.step(1); });
  waitOutTheDeadline(clock, world, "hung up on: no result within the step deadline");
  EXPECT_EQ(step.get().step(), 1u);
  worker->signal(SIGCONT);
  world.waitForLog(": ready", 2);
  panel.start();
  EXPECT_EQ(world.wait(), Served::to_its_end);
  const Ended alone = runProgram("run worlds/small_maze.xml --controller wander --json --time 10");
  EXPECT_EQ(world.digest(), nlohmann::json::parse(alone.out)["digest"]);
  EXPECT_EQ(worker->wait().exit_code, 0) << worker->error();
}

TEST(Faults, OfTwoProcessesThatClaimOneRobotCostTheSecondItsConnection) {
  TwoRobots two;
  const Ended second = startRobots({"Pioneer1"}, two.world.dialOptions().address)->wait();
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("robot 'Pioneer1' is driven by another process already, at ipv4:"), std::string::npos)
      << second.err;
  EXPECT_EQ(countOf("refused: robot 'Pioneer1' is driven by another process", two.world.log()), 1u);
  const auto before = two.pose(0);
  two.panel.step(20);
  EXPECT_NE(two.pose(0), before);
  EXPECT_EQ(two.panel.status().robots_connected(), 2u);
}

/// A robot's process that says what it likes.
class RudeRobot {
 public:
  explicit RudeRobot(const ServedWorld& world)
      : stub_(wire::Robots::NewStub(dial(world.dialOptions()))), stream_(stub_->Drive(&context_)) {}
  void hello(const std::string& name, const std::string& world_version = "") {
    wire::FromRobots message;
    message.mutable_hello()->set_protocol(kProtocolVersion);
    message.mutable_hello()->add_names(name);
    message.mutable_hello()->set_world_version(world_version);
    say(message);
  }
  void say(const wire::FromRobots& message) { stream_->Write(message); }
  wire::ToRobots hear() {
    wire::ToRobots message;
    EXPECT_TRUE(stream_->Read(&message));
    return message;
  }
  grpc::Status howItEnds() {
    for (wire::ToRobots message; stream_->Read(&message);) {
    }
    return stream_->Finish();
  }

 private:
  std::unique_ptr<wire::Robots::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<wire::FromRobots, wire::ToRobots>> stream_;
};

TEST(Faults, OfARobotThatCommandsAnotherCostItItsConnectionAndTheOtherNothing) {
  HandClock clock;
  ServedWorld world(pausedMaze(clock));
  Panel panel(world);
  RudeRobot pioneer(world);
  pioneer.hello("Pioneer1");
  const auto scout = startRobots({"Scout1"}, world.dialOptions().address);
  pioneer.hear();
  wire::FromRobots answer;
  answer.set_step(pioneer.hear().step());
  auto& command = *answer.add_commands();
  command.set_robot(1);  // its process has one robot, number 0
  command.set_speed_mps(1);
  pioneer.say(answer);
  const grpc::Status status = pioneer.howItEnds();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(status.error_message().find("a command for robot 1 of 1"), std::string::npos) << status.error_message();
  const auto scout_before = world.state().world_from_robot[1];
  panel.step(20);
  EXPECT_NE(world.state().world_from_robot[1], scout_before);
  EXPECT_EQ(world.state().driven_m[0], 0);
  EXPECT_EQ(countOf("hung up on: a command for robot 1 of 1", world.log()), 1u) << world.log();
}

TEST(Faults, OfRobotsFromAnotherWorldAreToldOfBothVersions) {
  HandClock clock;
  ServedWorld world(pausedMaze(clock));
  RudeRobot pioneer(world);
  pioneer.hello("Pioneer1", "0123456789abcdef");
  const grpc::Status status = pioneer.howItEnds();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_NE(status.error_message().find("the world version '0123456789abcdef', and here is version "),
            std::string::npos)
      << status.error_message();
  world.waitForLog("refused: the robots come from the world version");
}

TEST(Faults, OfAnswersToOtherStepsThanTheOneAskedCostTheConnection) {
  HandClock clock;
  ServedWorld world(pausedMaze(clock));
  RudeRobot pioneer(world);
  const auto scout = startRobots({"Scout1"}, world.dialOptions().address);
  pioneer.hello("Pioneer1");
  pioneer.hear();
  wire::FromRobots answer;
  answer.set_step(pioneer.hear().step());
  pioneer.say(answer);
  pioneer.say(answer);
  Panel(world).step(2);
  const grpc::Status status = pioneer.howItEnds();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(),
            "an answer to step 0 when step 1 was asked; answer each step once, when its readings have come");
}

TEST(Faults, OfAnEnvironmentThatIsHeldUpItselfCostNoRobotItsConnection) {
  HandClock clock;
  ServedWorld world(pausedMaze(clock));
  RudeRobot pioneer(world), scout(world);
  pioneer.hello("Pioneer1");
  scout.hello("Scout1");
  auto step = std::async(std::launch::async, [&] { return Panel(world).step(1); });
  for (RudeRobot* robot : {&pioneer, &scout}) {
    robot->hear();
    robot->hear();
  }
  clock.waitUntilSeen();
  clock.hold();
  wire::FromRobots answer;
  answer.set_step(0);
  for (RudeRobot* robot : {&pioneer, &scout}) robot->say(answer);
  clock.advance(kStepDeadline);
  std::this_thread::sleep_for(2 * Lobby::kNap);  // so that it finds its nap over, too
  clock.release();
  EXPECT_EQ(step.get().step(), 1u);
  EXPECT_EQ(countOf("hung up on", world.log()), 0u) << world.log();
}

TEST(Faults, OfAGeometryWorkerFrozenKeepNobodyFromEndingTheRun) {
  HandClock clock;  // whose deadline never comes
  ServedWorld::Options options = pausedMaze(clock);
  options.robots_elsewhere = false;
  ServedWorld world(options);
  const auto worker = startWorker(world.dialOptions().address);
  world.waitForLog(": ready");
  worker->signal(SIGSTOP);
  Panel(world).start();
  clock.waitUntilSeen();
  EXPECT_EQ(world.end(), Served::interrupted);
  EXPECT_EQ(countOf("hung up on: the run was interrupted", world.log()), 1u) << world.log();
  worker->signal(SIGCONT);
}

TEST(Faults, OfAClientThatConnectsAndSaysNothingCostItItsConnectionAfterTenSeconds) {
  HandClock clock;
  ServedWorld world(pausedMaze(clock));
  RudeRobot silent(world), talker(world);
  talker.say({});
  EXPECT_EQ(talker.howItEnds().error_message(), "the first message of a robot's process must be its hello");
  // Both came over one connection, the silent one first. So it is there, and its time runs.
  clock.advance(10s - 1ns);
  clock.waitUntilSeen();
  EXPECT_EQ(countOf("no hello", world.log()), 0u);
  clock.advance(1ns);
  const grpc::Status status = silent.howItEnds();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_EQ(status.error_message(), "no hello within 10000 ms of connecting; the first message must be one, at once");
}

TEST(Faults, OfAMachineThatFallsSilentAreNoticedAtBothEnds) {
  HandClock clock;
  ServedWorld::Options options = pausedMaze(clock);
  options.server.keepalive = 100ms;
  ServedWorld world(options);
  CutLine line(world.port());
  DialOptions dialled{.address = line.address()};
  dialled.keepalive = 100ms;
  NetworkHardware pioneer(dialled, {"Pioneer1"});
  line.fallSilent();
  world.waitForLog("robot Pioneer1 (ipv4:");
  world.waitForLog("): has left");
  EXPECT_THROW(pioneer.nextStep(), ConnectionError);
}

TEST(Faults, OfAnEnvironmentStoppedBySigtermWhileItRecordsLeaveAReadableRawlog) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  Serving serving({"--wait-for-robots", "--json", "--record", rawlog.string(), "--step-deadline", "600"});
  const auto robots = startRobots({"Pioneer1", "Scout1"}, serving.address());
  serving.program().waitForError("all robots are here");
  serving.program().signal(SIGTERM);
  const Ended ended = serving.program().wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(nlohmann::json::parse(ended.out)["ended_by"], "interrupt");
  EXPECT_EQ(countOf("has left", ended.err), 0u) << "it has said goodbye";
  const ToolRun tool = runTool("rawlog-edit --info -i run.rawlog", folder);
  EXPECT_EQ(tool.exit_code, 0) << tool.output;
  const Ended said_goodbye_to = robots->wait();
  EXPECT_EQ(said_goodbye_to.exit_code, 0) << said_goodbye_to.err;
  EXPECT_NE(said_goodbye_to.out.find("the run is over after "), std::string::npos);
}

TEST(Faults, OfAnEnvironmentKilledEndItsRobotsWhenTheirPatienceHasEnded) {
  Serving serving({"--wait-for-robots"});
  StartedProgram robots({"robot", "Pioneer1", "Scout1", "--environment", serving.address(), "--patience", "0.5"});
  serving.program().waitForError("all robots are here");
  serving.program().signal(SIGKILL);
  const Ended ended = robots.wait();
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("robosim: no environment answers at " + serving.address()), std::string::npos) << ended.err;
}

TEST(Faults, OfNamesThatAreNotUtf8AreToldBeforeAnyoneConnects) {
  const auto folder = emptyFolder();
  std::string text = textOf(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml");
  std::ofstream(folder / "maze_\xE9.xml", std::ios::binary) << text;
  for (auto at = text.find("Scout1"); at != std::string::npos; at = text.find("Scout1")) {
    text.replace(at, 6, "Pr\xF9zkumn\xEDk");
  }
  std::ofstream(folder / "latin_1.xml", std::ios::binary) << text;
  const std::pair<const char*, const char*> faults[] = {
      {"maze_\xE9.xml", "the name of the world 'maze_?' is not UTF-8"},
      {"latin_1.xml", "latin_1.xml:105: a letter is not in the file's encoding"},
  };
  for (const auto& [world, fault] : faults) {
    const Ended ended = runProgram("serve '" + (folder / world).string() + "' --listen :0");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_NE(ended.err.find(fault), std::string::npos) << ended.err;
  }
}

TEST(Realtime, LetsALateRobotKeepItsLastCommandAndSaysHowOften) {
  Serving serving(
      {"--wait-for-robots", "--json", "--pace", "realtime", "--speed", "20", "--time", "60", "--step-deadline", "600"});
  const auto pioneer = startRobots({"Pioneer1"}, serving.address());
  const auto scout = startRobots({"Scout1"}, serving.address());
  serving.program().waitForError("all robots are here");
  pioneer->signal(SIGSTOP);
  const auto summary = nlohmann::json::parse(serving.program().wait().out);
  EXPECT_EQ(summary["steps"], 600);
  EXPECT_GE(summary["late"], 100);
}

}  // namespace
}  // namespace robosim
