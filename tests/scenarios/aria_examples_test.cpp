// The installed interface with ARIA's names, used by a separate project: the controllers of doc/examples/aria.
#include <memory>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/installed_project.h"

namespace robosim {
namespace {

class AriaExamples : public testing::Test {
 protected:
  void SetUp() override {
    if (!installed_) installed_ = std::make_unique<InstalledProject>("aria");
  }
  static void TearDownTestSuite() { installed_.reset(); }

  static std::string plugin() { return " --plugin " + quoted(installed_->library("aria")); }
  /// Summary of a run in the example's room.
  static nlohmann::json summaryOf(const std::string& arguments, const std::string& input = "") {
    const Ended ended = installed_->run("run room.xml --json " + arguments + plugin(), input);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return nlohmann::json::parse(ended.out);
  }

  static std::unique_ptr<InstalledProject> installed_;
};
std::unique_ptr<InstalledProject> AriaExamples::installed_;

TEST_F(AriaExamples, WanderDrivesWithoutStalling) {
  const auto summary = summaryOf("--controller aria_wander --time 120");
  EXPECT_EQ(summary["ended_by"], "time_limit");
  EXPECT_GT(summary["driven_m"], 20);
  EXPECT_EQ(summary["stalls"], 0);
}

TEST_F(AriaExamples, GotoReturnsToItsStartPastThePillarAndHalts) {
  const auto summary = summaryOf("--controller aria_goto --time 120");
  EXPECT_EQ(summary["ended_by"], "all_halted");
  EXPECT_EQ(summary["stalls"], 0);
  EXPECT_GT(summary["driven_m"], 4 * 2.5 - 1);
  EXPECT_LT(summary["driven_m"], 4 * 2.5 + 2);
}

TEST_F(AriaExamples, GiveTheSameRunEachTime) {
  for (const std::string controller : {"aria_wander", "aria_goto"}) {
    const std::string arguments = "--controller " + controller + " --time 60";
    EXPECT_EQ(summaryOf(arguments)["digest"], summaryOf(arguments)["digest"]) << controller;
  }
}

TEST_F(AriaExamples, TeleopDrivesByKeysFromAPipe) {
  // Eight times up are 200 mm/s; ten left turns of 8° at 10 per second; then the space bar and, two seconds later, q.
  const std::string keys =
      "printf "
      "'\\033[A\\033[A\\033[A\\033[A\\033[A\\033[A\\033[A\\033[A....................\\033[D\\033[D\\033[D\\033[D\\033[D"
      "\\033[D\\033[D\\033[D\\033[D\\033[D ....................q'";
  const auto summary = summaryOf("--controller aria_teleop --time 60", keys);
  EXPECT_EQ(summary["ended_by"], "all_halted");
  EXPECT_EQ(summary["steps"], 61);  // 60 keys; the robot halts in the step after q
  // 0.8 s of acceleration to 0.2 m/s, 3 s at that speed, and 0.67 s of braking at 0.3 m/s².
  EXPECT_NEAR(summary["driven_m"], 0.08 + 0.6 + 0.067, 0.04);
  EXPECT_EQ(summaryOf("--controller aria_teleop --time 60", keys)["digest"], summary["digest"]);
}

TEST_F(AriaExamples, TeleopRefusesASecondRobot) {
  const Ended ended =
      installed_->run("run room.xml --robot pioneer3dx@2,2,0 --controller aria_teleop --time 5" + plugin());
  EXPECT_EQ(ended.exit_code, 2) << ended.out;
  EXPECT_NE(ended.err.find("the keyboard drives another robot already; give this one another controller"),
            std::string::npos)
      << ended.err;
}

TEST_F(AriaExamples, DriveARobotOfAServerAsInProcess) {
  StartedProgram serve(installed_->program().string(),
                       {"serve", (installed_->folder() / "room.xml").string(), "--listen", ":0", "--wait-for-robots",
                        "--step-deadline", "600", "--time", "120", "--json"});
  serve.waitForError("listening on ");
  const std::string log = serve.error();
  const auto at = log.find("listening on ") + 13;
  const Ended robot = installed_->run("robot Pioneer --controller aria_goto --environment " +
                                      log.substr(at, log.find_first_of(" \n", at) - at) + plugin());
  EXPECT_EQ(robot.exit_code, 0) << robot.err;
  const auto served = nlohmann::json::parse(serve.wait().out);
  EXPECT_EQ(served["digest"], summaryOf("--controller aria_goto --time 120")["digest"]);
}

// The simulated robot behind its ARCOS port, as a real one behind its serial line: in real time, so that what delays
// the program by a second makes it pass its goal by five times the way of a second.
TEST_F(AriaExamples, DriveARobotThroughArcos) {
  for (const std::string controller : {"aria_wander", "aria_goto"}) {
    StartedProgram serve(installed_->program().string(),
                         {"serve", (installed_->folder() / "room.xml").string(), "--listen", ":0", "--arcos", "0",
                          "--arcos-all", "--speed", "5", "--time", "80", "--json"});
    const std::string announcement = "robot Pioneer (pioneer3dx) for ARCOS programs on ";
    serve.waitForError("listening on ");
    const std::string log = serve.error();
    const auto at = log.find(announcement);
    ASSERT_NE(at, std::string::npos) << log;
    const std::string address = log.substr(at + announcement.size(), log.find('\n', at) - at - announcement.size());
    StartedProgram robot(installed_->program().string(),
                         {"robot", "--arcos", "tcp:" + address, "--controller", controller, "--plugin",
                          installed_->library("aria").string()});
    const auto summary = nlohmann::json::parse(serve.wait().out);
    const Ended ended = robot.wait();
    EXPECT_EQ(summary["stalls"], 0) << controller;
    if (controller == "aria_wander") {
      EXPECT_GT(summary["driven_m"], 13);
    } else {  // to its four goals, and then it stands
      EXPECT_EQ(ended.exit_code, 0) << ended.err;
      EXPECT_GT(summary["driven_m"], 4 * 2.5 - 1);
      EXPECT_LT(summary["driven_m"], 4 * 2.5 + 2);
    }
  }
}

}  // namespace
}  // namespace robosim
