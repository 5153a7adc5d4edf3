// A broken connection neither loses nor duplicates messages; in lockstep the run is identical to one without the break.
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client/network_hardware.h"
#include "net/robot_wire.h"
#include "robosim/v1/robots.grpc.pb.h"
#include "tests/scenarios/beside_run.h"
#include "tests/scenarios/fault_proxy.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/verifying.h"

namespace robosim {
namespace {

ServedWorld::Options robotsElsewhere(OnLostRobot policy) {
  ServedWorld::Options options = paused();
  options.robots_elsewhere = true;
  options.server.on_lost_robot = policy;
  return options;
}

/// Number of connections cut in the long variant.
int cuts() { return isVerifying() ? 400 : 30; }

TEST(Reconnection, DoesNotChangeTheRunWhereverConnectionsAreCut) {
  const auto in_one = nlohmann::json::parse(runProgram("run worlds/small_maze.xml --json").out);
  ASSERT_GE(in_one["messages"].get<int>(), 1) << "the ring passes on that the gold is found";
  ServedWorld::Options options = robotsElsewhere(OnLostRobot::wait);
  options.last_step = in_one["steps"];
  ServedWorld world(options);
  FaultProxy pioneer_line(world.port()), scout_line(world.port());
  const auto pioneer = startRobots({"Pioneer1"}, pioneer_line.address(), "gold_finder");
  const auto scout = startRobots({"Scout1"}, scout_line.address(), "gold_finder");
  world.waitForLog("all robots are connected");
  Panel panel(world);
  panel.step(1);  // both programs have connected; they do not retry their first call
  std::mt19937 random(1);
  const std::uint64_t steps_per_cut = std::max<std::uint64_t>(1, options.last_step / static_cast<unsigned>(cuts()));
  for (std::uint64_t step = 1; step + steps_per_cut < options.last_step; step += steps_per_cut) {
    FaultProxy& line = random() % 2 ? pioneer_line : scout_line;
    const int bytes = 1 + static_cast<int>(random() % 300);
    random() % 2 ? line.cutAfter(bytes) : line.cutRepliesAfter(bytes);
    panel.step(steps_per_cut);
  }
  panel.start();
  EXPECT_EQ(world.wait(), Served::to_its_end);
  EXPECT_EQ(world.digest(), in_one["digest"].get<std::string>());
  EXPECT_EQ(world.state().messages_delivered, in_one["messages"]);
  EXPECT_TRUE(world.report().hasAllRobots());
  std::uint64_t times = 0;
  for (const auto& robot : world.report().lost_robots) times += robot.times;
  EXPECT_GE(times, static_cast<unsigned>(cuts()) / 3) << "some cuts fall on a connection that is being made";
}

TEST(BesideRun, EndsTheRunOfATestThatEndsEarly) {
  ServedWorld world(robotsElsewhere(OnLostRobot::wait));
  Panel panel(world);
  const auto test = [&] {
    const BesideRun step(world, [&] { return panel.step(1); });  // waits for robots, which never connect
    throw std::runtime_error("unexpected");
  };
  EXPECT_THROW(test(), std::runtime_error);
  EXPECT_EQ(world.wait(), Served::interrupted);
}

/// Takes steps as a robot process, and stores received messages, until the run is over.
std::vector<std::string> inboxUntilTheEnd(NetworkHardware& robots) {
  std::vector<std::string> texts;
  do {
    for (const auto& message : robots.robot(0).readings().inbox) texts.push_back(message.from + ": " + message.text);
  } while (robots.nextStep());
  return texts;
}

TEST(Reconnection, ResendsUnconfirmedMessages) {
  ServedWorld world(robotsElsewhere(OnLostRobot::continue_));
  FaultProxy line(world.port());
  NetworkHardware pioneer(world.connectOptions(), {"Pioneer1"});
  NetworkHardware scout({.address = line.address()}, {"Scout1"});
  BesideRun inbox(world, [&] { return inboxUntilTheEnd(pioneer); });
  line.cutAfter(3);
  scout.robot(0).send("Pioneer1", "GOLD Scout1");
  EXPECT_THROW(scout.nextStep(), ConnectionError);
  EXPECT_EQ(scout.unconfirmedMessages(), 1u);
  scout.robot(0).send("Pioneer1", "sent since");
  world.waitForLog("): has left");
  Panel panel(world);
  panel.step(3);
  scout.rejoin();
  EXPECT_EQ(scout.robot(0).readings().time.step, 3u);
  EXPECT_FALSE(scout.hasAnswered()) << "its last answer was to step 0";
  BesideRun steps(world, [&] { return panel.step(2); });
  EXPECT_TRUE(scout.nextStep());
  EXPECT_EQ(scout.unconfirmedMessages(), 0u);
  EXPECT_TRUE(scout.nextStep());
  steps.get();
  panel.stop();
  EXPECT_EQ(inbox.get(), (std::vector<std::string>{"Scout1: GOLD Scout1", "Scout1: sent since"}))
      << "exactly once, and in the order in which they were sent";
  world.wait();
  EXPECT_EQ(world.report().messages_lost, 0u);
}

TEST(Reconnection, ResendsTheAnswerToTheCurrentStep) {
  ServedWorld world(robotsElsewhere(OnLostRobot::wait));
  FaultProxy line(world.port());
  NetworkHardware pioneer(world.connectOptions(), {"Pioneer1"});
  NetworkHardware scout({.address = line.address()}, {"Scout1"});
  BesideRun inbox(world, [&] { return inboxUntilTheEnd(pioneer); });
  line.cutAfter(3);
  scout.robot(0).command({0.25, 0, 0, Activity::active});
  scout.robot(0).send("Pioneer1", "GOLD Scout1");
  EXPECT_THROW(scout.nextStep(), ConnectionError);
  world.waitForLog("): has left");
  scout.rejoin();
  EXPECT_TRUE(scout.hasAnswered());
  Panel panel(world);
  BesideRun steps(world, [&] { return panel.step(5); });
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(scout.nextStep());
  steps.get();
  EXPECT_GT(world.state().driven_m[1], 0) << "the command that was cut off counts";
  panel.stop();
  EXPECT_EQ(inbox.get(), std::vector<std::string>{"Scout1: GOLD Scout1"}) << "exactly once";
}

TEST(Reconnection, RepeatsTheLastCommandAfterStepsWithoutTheRobot) {
  ServedWorld world(robotsElsewhere(OnLostRobot::continue_));
  FaultProxy line(world.port());
  NetworkHardware pioneer(world.connectOptions(), {"Pioneer1"});
  NetworkHardware scout({.address = line.address()}, {"Scout1"});
  BesideRun inbox(world, [&] { return inboxUntilTheEnd(pioneer); });
  line.cutAfter(3);
  scout.robot(0).command({0.25, 0, 0, Activity::active});
  EXPECT_THROW(scout.nextStep(), ConnectionError);
  world.waitForLog("): has left");
  Panel panel(world);
  panel.step(3);
  EXPECT_EQ(world.state().driven_m[1], 0) << "it stands still while its process is absent";
  scout.rejoin();
  BesideRun steps(world, [&] { return panel.step(2); });
  EXPECT_TRUE(scout.nextStep());
  EXPECT_TRUE(scout.nextStep());
  steps.get();
  EXPECT_GT(world.state().driven_m[1], 0);
  panel.stop();
  inbox.get();
}

/// A connection of a process that drives Scout1, or the given robots.
struct BareProcess {
  BareProcess(const ServedWorld& world, const std::string& process, const std::string& run,
              const std::vector<std::string>& robots = {"Scout1"})
      : BareProcess(v1::Robots::NewStub(connect(world.connectOptions())), process, run, robots) {}
  BareProcess(std::shared_ptr<v1::Robots::Stub> over, const std::string& process, const std::string& run,
              const std::vector<std::string>& robots, const std::string& token = "")
      : stub(std::move(over)) {
    attachToken(context, {.token = token});
    stream = stub->Drive(&context);
    v1::DriveRequest first;
    first.mutable_hello()->set_protocol(kProtocolVersion);
    for (const auto& name : robots) first.mutable_hello()->add_names(name);
    first.mutable_hello()->set_process(process);
    first.mutable_hello()->set_run(run);
    stream->Write(first);
    is_welcome = stream->Read(&welcome);
  }
  ~BareProcess() { context.TryCancel(); }

  grpc::ClientContext context;
  std::shared_ptr<v1::Robots::Stub> stub;
  std::unique_ptr<grpc::ClientReaderWriter<v1::DriveRequest, v1::DriveResponse>> stream;
  v1::DriveResponse welcome;
  bool is_welcome = false;
};

TEST(Reconnection, ReplacesAnUndetectedLostConnectionOfTheSameProcess) {
  const std::string process(kProcessIdBytes, 'p'), other(kProcessIdBytes, 'q');
  ServedWorld world(robotsElsewhere(OnLostRobot::wait));
  BareProcess first(world, process, "");
  ASSERT_TRUE(first.is_welcome);
  const std::string run = first.welcome.welcome().run();
  BareProcess second(world, process, run);
  EXPECT_TRUE(second.is_welcome);
  while (first.stream->Read(&first.welcome)) {
  }
  EXPECT_EQ(first.stream->Finish().error_code(), grpc::StatusCode::ABORTED);
  for (const std::string& id : {other, std::string(), process.substr(1)}) {
    BareProcess foreign(world, id, run);
    EXPECT_FALSE(foreign.is_welcome);
    EXPECT_EQ(foreign.stream->Finish().error_code(), grpc::StatusCode::ALREADY_EXISTS);
  }
}

TEST(Reconnection, DoesNotReplaceTheConnectionOfAProcessWithAnotherToken) {
  const std::string process(kProcessIdBytes, 'p');
  const std::string token = "robots-0123456789ab", other_token = "master-0123456789ab";
  ServedWorld::Options options = robotsElsewhere(OnLostRobot::wait);
  options.server.access = Access::parse(token + " robot Scout1\n" + other_token + " operator\n", "tokens");
  ServedWorld world(options);
  const auto connectAs = [&](const std::string& with_token, const std::string& run) {
    return std::make_unique<BareProcess>(v1::Robots::NewStub(connect(world.connectOptions())), process, run,
                                         std::vector<std::string>{"Scout1"}, with_token);
  };
  const auto first = connectAs(token, "");
  ASSERT_TRUE(first->is_welcome);
  const std::string run = first->welcome.welcome().run();
  const auto foreign = connectAs(other_token, run);
  EXPECT_FALSE(foreign->is_welcome);
  EXPECT_EQ(foreign->stream->Finish().error_code(), grpc::StatusCode::ALREADY_EXISTS);
  EXPECT_TRUE(connectAs(token, run)->is_welcome);
}

TEST(Reconnection, DoesNotReplaceTheConnectionOfAProcessWithoutAnId) {
  ServedWorld world(robotsElsewhere(OnLostRobot::wait));
  BareProcess first(world, "", "");
  ASSERT_TRUE(first.is_welcome);
  BareProcess second(world, "", first.welcome.welcome().run());
  EXPECT_EQ(second.stream->Finish().error_code(), grpc::StatusCode::ALREADY_EXISTS);
}

/// Sends the answer to step 0, with messages that the process has dropped.
void answerFirstStep(BareProcess& process, std::uint64_t messages_dropped) {
  v1::DriveResponse readings;
  ASSERT_TRUE(process.stream->Read(&readings));
  v1::DriveRequest answer;
  answer.mutable_answer()->set_step(0);
  answer.mutable_answer()->set_messages_dropped(messages_dropped);
  process.stream->Write(answer);
}

TEST(Reconnection, CountsTheDroppedMessagesOfAProcessThatAnswersAndLeavesOnce) {
  const std::string process(kProcessIdBytes, 'p');
  const std::vector<std::string> robots{"Pioneer1", "Scout1"};
  ServedWorld world(robotsElsewhere(OnLostRobot::continue_));
  BareProcess first(world, process, "", robots);
  answerFirstStep(first, 3);
  // Over the same connection, so that the answer arrives before the hello, which ends the first call.
  BareProcess second(first.stub, process, "", robots);
  ASSERT_TRUE(second.is_welcome);
  answerFirstStep(second, 0);
  Panel(world).step(1);
  EXPECT_EQ(world.state().messages_dropped, 3u);
}

void connectAndLeave(ServedWorld& world, const std::string& robot) {
  { const NetworkHardware hardware(world.connectOptions(), {robot}); }
  world.waitForLog("): has left");
}

TEST(Reconnection, StoresMessagesForAnAbsentRobot) {
  ServedWorld world(robotsElsewhere(OnLostRobot::continue_));
  NetworkHardware pioneer(world.connectOptions(), {"Pioneer1"});
  connectAndLeave(world, "Scout1");
  Panel panel(world);
  BesideRun steps(world, [&] { return panel.step(2); });
  pioneer.robot(0).send("Scout1", "first");
  EXPECT_TRUE(pioneer.nextStep());
  pioneer.robot(0).send("Scout1", "second");
  EXPECT_TRUE(pioneer.nextStep());
  steps.get();
  NetworkHardware again(world.connectOptions(), {"Scout1"});
  const auto& inbox = again.robot(0).readings().inbox;
  ASSERT_EQ(inbox.size(), 2u);
  EXPECT_EQ(inbox[0].text, "first");
  EXPECT_EQ(inbox[1].text, "second");
}

TEST(Reconnection, CountsMessagesForARobotAbsentAtTheEndAsLost) {
  ServedWorld world(robotsElsewhere(OnLostRobot::continue_));
  NetworkHardware pioneer(world.connectOptions(), {"Pioneer1"});
  connectAndLeave(world, "Scout1");
  Panel panel(world);
  BesideRun step(world, [&] { return panel.step(1); });
  pioneer.robot(0).send("Scout1", "GOLD Pioneer1");
  EXPECT_TRUE(pioneer.nextStep());
  step.get();
  EXPECT_EQ(panel.status().messages_lost(), 1u);
  panel.stop();
  world.wait();
  EXPECT_EQ(world.report().messages_lost, 1u);
  EXPECT_FALSE(world.report().hasAllRobots());
}

}  // namespace
}  // namespace robosim
