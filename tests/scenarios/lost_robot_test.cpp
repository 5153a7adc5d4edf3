// A robot process that ends: effect of --on-lost-robot, and reports in the summary, the exit code and the control
// panel.
#include <csignal>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/certificates.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

using nlohmann::json;

constexpr int kIncomplete = 3;

/// `robosim serve`, paused, with Pioneer1 and Scout1 in a process each, after ten steps.
class TwoServedRobots {
 public:
  explicit TwoServedRobots(std::vector<std::string> options) : serving_(with(std::move(options))) {
    pioneer_ = startRobots({"Pioneer1"}, serving_.address());
    scout_ = startRobots({"Scout1"}, serving_.address());
    serving_.program().waitForError("all robots are connected");
    control("step 10");
  }

  std::string control(const std::string& what) const {
    const Ended ended = runProgram("control " + serving_.address() + " " + what);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended.out;
  }
  void killPioneer() {
    pioneer_->signal(SIGKILL);
    serving_.program().waitForError("): has left");
  }
  void startPioneerAgain() { pioneer_ = startRobots({"Pioneer1"}, serving_.address()); }
  StartedProgram& program() { return serving_.program(); }
  const std::string& address() const { return serving_.address(); }

 private:
  static std::vector<std::string> with(std::vector<std::string> options) {
    options.insert(options.end(), {"--wait-for-robots", "--paused"});
    return options;
  }
  Serving serving_;
  std::unique_ptr<StartedProgram> pioneer_, scout_;
};

json clientsOf(const Ended& ended) { return json::parse(ended.out)["clients"]; }

TEST(LostRobot, IsAwaitedInLockstepAndTheRunIsComplete) {
  TwoServedRobots two({"--json"});
  two.killPioneer();
  two.program().waitForError("waiting for Pioneer1");
  StartedProgram steps({"control", two.address(), "step", "5"});
  const std::string status = two.control("status");
  EXPECT_NE(status.find("waits for robots at step 10"), std::string::npos) << status;
  EXPECT_NE(status.find("Pioneer1, 1 times, not back; 0 steps were taken without it (--on-lost-robot wait)"),
            std::string::npos)
      << status;
  two.startPioneerAgain();
  EXPECT_EQ(steps.wait().exit_code, 0);
  two.control("stop");
  const Ended ended = two.program().wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(json::parse(ended.out)["steps"], 15);
  const json clients = clientsOf(ended);
  EXPECT_EQ(clients["all_robots"], true);
  EXPECT_EQ(clients["on_lost_robot"], "wait");
  EXPECT_EQ(clients["lost_robots"],
            json::parse(R"([{"name": "Pioneer1", "times": 1, "steps_missed": 0, "is_lost": false, "restarts": 1}])"));
  EXPECT_EQ(clients["restarted_robots"], json::parse(R"(["Pioneer1"])"));
}

TEST(LostRobot, MakesTheRunIncompleteIfAbsentAtItsEnd) {
  TwoServedRobots two({"--json"});
  two.killPioneer();
  two.control("stop");
  const Ended ended = two.program().wait();
  EXPECT_EQ(ended.exit_code, kIncomplete) << ended.err;
  EXPECT_EQ(clientsOf(ended)["all_robots"], false);
}

TEST(LostRobot, WithContinueStandsStillAndTheRunIsIncomplete) {
  TwoServedRobots two({"--json", "--on-lost-robot", "continue"});
  two.killPioneer();
  two.control("step 100");
  two.control("stop");
  const Ended ended = two.program().wait();
  EXPECT_EQ(ended.exit_code, kIncomplete) << ended.err;
  const json clients = clientsOf(ended);
  EXPECT_EQ(clients["all_robots"], false);
  EXPECT_EQ(clients["lost_robots"],
            json::parse(R"([{"name": "Pioneer1", "times": 1, "steps_missed": 100, "is_lost": true, "restarts": 0}])"));
}

TEST(LostRobot, IsNamedInTheSummaryAndInTheRecording) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  TwoServedRobots two({"--on-lost-robot", "continue", "--record", rawlog.string()});
  two.killPioneer();
  two.control("step 7");
  two.startPioneerAgain();
  two.program().waitForError("): connected", 3);
  two.control("step 1");
  two.control("stop");
  const Ended ended = two.program().wait();
  EXPECT_EQ(ended.exit_code, kIncomplete) << ended.err;
  EXPECT_NE(ended.out.find("INCOMPLETE: steps were taken without some robots"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("Pioneer1, once, "), std::string::npos) << ended.out;
  const std::string restarted = "not reproducible: controllers of Pioneer1 were restarted";
  EXPECT_NE(ended.out.find(restarted), std::string::npos) << ended.out;
  const Ended replay = runProgram("replay '" + rawlog.string() + "'");
  EXPECT_NE(replay.out.find("INCOMPLETE: without some robots"), std::string::npos) << replay.out;
  EXPECT_NE(replay.out.find(restarted), std::string::npos) << replay.out;
}

TEST(LostRobot, WithFailEndsTheRun) {
  TwoServedRobots two({"--json", "--on-lost-robot", "fail"});
  two.killPioneer();
  const Ended ended = two.program().wait();
  EXPECT_EQ(ended.exit_code, kIncomplete) << ended.err;
  EXPECT_NE(ended.err.find("the run ends because of --on-lost-robot fail: lost Pioneer1"), std::string::npos);
  const json summary = json::parse(ended.out);
  EXPECT_EQ(summary["ended_by"], "robot_lost");
  EXPECT_EQ(summary["steps"], 10) << "no step is taken without it";
}

TEST(LostRobot, IsNotAwaitedInRealTime) {
  TwoServedRobots two({"--json", "--pace", "realtime", "--speed", "50"});
  two.killPioneer();
  two.control("step 20");
  two.control("stop");
  const Ended ended = two.program().wait();
  EXPECT_EQ(ended.exit_code, kIncomplete) << ended.err;
  EXPECT_EQ(clientsOf(ended)["on_lost_robot"], "continue");
}

/// The robots of a server that is killed, as on a restart of its machine, and of another that then listens at its
/// address.
/// @param tls whether both use TLS
void expectEndOfStaleRobots(bool tls) {
  std::vector<std::string> of_server, of_client;
  if (tls) {
    const auto folder = certificates();
    of_server = {"--tls-cert", folder / "cert.pem", "--tls-key", folder / "key.pem"};
    of_client = {"--tls-ca", folder / "cert.pem"};
  }
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  auto first = std::make_unique<Serving>(with({"--wait-for-robots", "--paused"}, of_server));
  const std::string address = first->address();
  const auto control = [&](const std::string& what) {
    return runProgram("control " + address + " " + what + (tls ? " --tls-ca '" + of_client.back() + "'" : ""));
  };
  StartedProgram stale(with(
      {"robot", "Pioneer1", "Scout1", "--controller", "wander", "--environment", address, "--reconnect-timeout", "600"},
      of_client));
  first->program().waitForError("all robots are connected");
  EXPECT_EQ(control("step 2").exit_code, 0);  // the robots have received the welcome
  first.reset();
  stale.waitForError("reconnecting");  // and attempts to connect are refused

  StartedProgram next(with({"serve", "worlds/small_maze.xml", "--listen", address, "--wait-for-robots", "--json",
                            "--time", "20", "--step-deadline", "600"},
                           of_server));
  const Ended ended = stale.wait();
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("the robots have joined the run '"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("restart their program to join it"), std::string::npos) << ended.err;
  const Ended status = control("status");
  EXPECT_NE(status.out.find("waits for robots at step 0"), std::string::npos) << status.out << status.err;

  const StartedProgram fresh(
      with({"robot", "Pioneer1", "Scout1", "--controller", "wander", "--environment", address}, of_client));
  const Ended run = next.wait();
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(json::parse(run.out)["steps"], 200);
  EXPECT_EQ(clientsOf(run)["lost_robots"], json::array());
}

TEST(StaleRobots, EndAndAreNotCountedAsPresentInTheNextRun) { expectEndOfStaleRobots(false); }

TEST(StaleRobots, EndWithTlsToo) { expectEndOfStaleRobots(true); }

}  // namespace
}  // namespace robosim
