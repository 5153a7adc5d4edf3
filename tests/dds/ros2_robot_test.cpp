// `robosim robot --ros2` with a robot of `robosim serve --ros2`.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dds/testing/domain.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

std::vector<std::string> robotArguments(const std::vector<std::string>& more) {
  std::vector<std::string> all{"robot", "--ros2", "/Pioneer1", "--domain", std::to_string(dds::testDomain())};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(Ros2Robot, OfAServedWorldIsDrivenByAControllerAndRecorded) {
  const auto rawlog = emptyFolder() / "robot.rawlog";
  StartedProgram server({"serve", ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", "--controller", "still", "--ros2",
                         "--domain", std::to_string(dds::testDomain()), "--speed", "5", "--listen", "127.0.0.1:0"});
  server.waitForError("listening on");
  StartedProgram robot(
      robotArguments({"--robot-type", "pioneer3dx", "--controller", "wander", "--record", rawlog.string()}));
  robot.waitForError("connected to /Pioneer1");
  server.waitForError("drive Pioneer1");
  ASSERT_TRUE(dds::eventually([&] { return std::filesystem::exists(rawlog.string() + ".part"); }));
  robot.interrupt();
  const Ended ended = robot.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("drove for "), std::string::npos) << ended.out;
  server.interrupt();
  EXPECT_EQ(server.wait().exit_code, 0);
  const Ended replay = runProgram("replay " + quoted(rawlog));
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_NE(replay.out.find("Pioneer1/laser"), std::string::npos) << replay.out;
}

TEST(Ros2Robot, RefusesWhatItCannotUse) {
  const auto error_of = [](const std::vector<std::string>& more) {
    StartedProgram robot(robotArguments(more));
    const Ended ended = robot.wait();
    EXPECT_NE(ended.exit_code, 0);
    return ended.err;
  };
  EXPECT_NE(error_of({"--controller", "wander"}).find("--ros2 needs --robot-type"), std::string::npos);
  EXPECT_NE(error_of({"--robot-type", "p3dx"}).find("--ros2 needs --controller"), std::string::npos);
  EXPECT_NE(error_of({"--robot-type", "p3dy", "--controller", "wander"}).find("there is no robot type 'p3dy'"),
            std::string::npos);
  EXPECT_NE(error_of({"--robot-type", "p3dx", "--controller", "wander", "--ros2-topic", "scan"}).find("scan=/robot1"),
            std::string::npos);
}

}  // namespace
}  // namespace robosim
