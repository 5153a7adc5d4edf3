// Output files of all commands: never replace an input, and are complete or absent, also after a signal or on a full
// disk.
#include <csignal>
#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

std::set<std::string> namesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

/// A world with a map, its image and a separate robot type; all inputs are in one folder.
class Inputs : public testing::Test {
 protected:
  Inputs() {
    std::ofstream(folder_ / "map.yaml") << "image: map.png\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
                                           "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    std::ofstream(folder_ / "map.png") << "P2 8 8 255\n" << whitePixels();
    fs::create_directory(folder_ / "robots");
    fs::copy_file(ROBOSIM_SOURCE_DIR "/worlds/robots/pioneer3dx.xml", folder_ / "robots" / "pioneer3dx.xml");
    std::ofstream(folder_ / "world.xml")
        << "<world><surface><map "
           "file='map.yaml'/><object><shape><robot><model>pioneer3dx</model><name>R</name><x>2</x><y>2"
           "</y><direction>0</direction><controller>wander</controller></robot></shape></"
           "object><object><shape><primitive>"
           "<cylinder><name>gold</name><x>3</x><y>3</y><z>0.1</z><radius>0.1</radius><height>0.2</height><hot>20</hot>"
           "<stationary>1</stationary></cylinder></primitive></shape></object></surface></world>";
    for (const char* name : kNames) before_[name] = textOf(folder_ / name);
  }

  /// Checks that the command is refused, names both files, and leaves all inputs unchanged.
  void expectRefusal(const std::string& arguments, const fs::path& output, const std::string& input) {
    const Ended ended = runProgram(arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments << ended.out;
    EXPECT_NE(ended.err.find(output.string() + ": would replace "), std::string::npos) << arguments << "\n"
                                                                                       << ended.err;
    EXPECT_NE(ended.err.find(input + ", which this command reads; choose another name"), std::string::npos)
        << ended.err;
    for (const char* name : kNames) EXPECT_EQ(textOf(folder_ / name), before_[name]) << name << " by " << arguments;
  }

  const fs::path folder_ = emptyFolder();
  static constexpr const char* kNames[] = {"map.yaml", "map.png", "world.xml", "robots/pioneer3dx.xml"};

 private:
  static std::string whitePixels() {
    std::string pixels;
    for (int i = 0; i < 64; ++i) pixels += "254 ";
    return pixels;
  }

  std::map<std::string, std::string> before_;
};

TEST_F(Inputs, AreNotReplacedByAnOutput) {
  const std::string world = quoted(folder_ / "world.xml");
  ASSERT_EQ(runProgram("check " + world).exit_code, 0) << runProgram("check " + world).out;
  const auto refuse = [&](const std::string& command, const fs::path& output, const std::string& input) {
    expectRefusal(command + quoted(output), output, input);
  };
  refuse("run " + world + " --time 1 --picture ", folder_ / "map.png", "map.png");
  refuse("run " + world + " --time 1 --record ", folder_ / "map.yaml", "map.yaml");
  refuse("run " + world + " --time 1 --record ", folder_ / "robots" / "pioneer3dx.xml", "pioneer3dx.xml");
  refuse("export " + world + " ", folder_ / "map.yaml", "map.yaml");
  expectRefusal("export " + world + " " + quoted(folder_ / "map.png"), folder_ / "map.yaml", "map.yaml");
  refuse("view " + world + " --offscreen ", folder_ / "map.png", "map.png");
  refuse("bench gold " + world + " --runs 1 --time 1 --csv ", folder_ / "map.yaml", "map.yaml");
}

TEST_F(Inputs, AreRecognisedByOtherPaths) {
  const std::string run = "run " + quoted(folder_ / "world.xml") + " --time 1 --picture ";
  fs::create_hard_link(folder_ / "map.png", folder_ / "hard.png");
  fs::create_symlink("map.png", folder_ / "soft.png");
  fs::create_directory(folder_ / "sub");
  for (const auto& other : {folder_ / "hard.png", folder_ / "soft.png", folder_ / "sub" / ".." / "map.png"}) {
    expectRefusal(run + quoted(other), other, "map.png");
  }
}

TEST_F(Inputs, AreNotReplacedByTheUnfinishedOutput) {
  const fs::path output = folder_ / "run.rawlog";
  fs::create_hard_link(folder_ / "map.yaml", folder_ / "run.rawlog.part");
  expectRefusal("run " + quoted(folder_ / "world.xml") + " --time 1 --record " + quoted(output), output, "map.yaml");
  const fs::path plan = folder_ / "plan.svg";
  fs::create_hard_link(folder_ / "map.yaml", folder_ / "plan.svg.part");
  expectRefusal("export " + quoted(folder_ / "world.xml") + " " + quoted(plan), plan, "map.yaml");
}

/// Runs the program with a limit of 4 KiB on the size of every file that it writes.
Ended runLimited(const std::string& arguments) {
  return runCommand("( ulimit -f 8; '" ROBOSIM_PROGRAM "' " + arguments + " )");
}

TEST(OutputFiles, LeaveNoPartialFileAtASizeLimit) {
  const fs::path folder = emptyFolder();
  for (const std::string& arguments :
       {"run worlds/small_maze.xml --time 60 --record " + quoted(folder / "a.rawlog"),
        "run worlds/small_maze.xml --time 60 --rawlog-format sf --record " + quoted(folder / "a.rawlog"),
        "run worlds/small_maze.xml --time 60 --picture " + quoted(folder / "a.png"),
        "run worlds/small_maze.xml --time 60 --picture " + quoted(folder / "a.pdf"),
        "export rawlogs/driven.rawlog " + quoted(folder / "a.svg") + " " + quoted(folder / "a.pdf"),
        "export worlds/small_maze.xml " + quoted(folder / "a.svg") + " " + quoted(folder / "a.gridmap"),
        "view worlds/small_maze.xml --offscreen " + quoted(folder / "a.png"),
        "bench gold worlds/small_maze.xml --time 0.1 --runs 100 --csv " + quoted(folder / "a.csv")}) {
    const Ended ended = runLimited(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments << ended.err;
    EXPECT_NE(ended.err.find("File too large"), std::string::npos) << arguments << ended.err;
    EXPECT_EQ(namesIn(folder), std::set<std::string>{}) << arguments;
  }
}

TEST(OutputFiles, AreReportedOnlyIfWritten) {
  const fs::path picture = emptyFolder() / "a.png";
  const Ended ended = runLimited("run worlds/small_maze.xml --time 60 --picture " + quoted(picture));
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.out.find("digest "), std::string::npos) << "the summary is not lost: " << ended.out;
  EXPECT_EQ(ended.out.find("picture "), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find(picture.string() + ": cannot be written"), std::string::npos) << ended.err;
}

TEST(OutputFiles, AreCompleteAfterAnInterrupt) {
  const fs::path folder = emptyFolder();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const fs::path rawlog = folder / "run.rawlog";
    fs::remove(rawlog);
    StartedProgram run({"run", "worlds/small_maze.xml", "--speed", "1", "--controller", "wander", "--record",
                        rawlog.string(), "--picture", (folder / "run.png").string()});
    run.waitForFile(rawlog.string() + ".part");
    run.signal(signal);
    const Ended ended = run.wait();
    EXPECT_EQ(ended.exit_code, 128 + signal) << ended.err;
    EXPECT_NE(ended.out.find("; interrupted\n"), std::string::npos) << ended.out;
    EXPECT_EQ(namesIn(folder), (std::set<std::string>{"run.png", "run.rawlog"}));
    const auto summary = nlohmann::json::parse(runProgram("replay --json " + quoted(rawlog)).out);
    EXPECT_EQ(summary["whole"], true);
    EXPECT_EQ(summary["run"]["outcome"]["ended_by"], "interrupted");
  }
}

TEST(OutputFiles, AreCompleteAfterHangupUnderNohup) {
  const fs::path rawlog = emptyFolder() / "run.rawlog";
  const Ended ended = runCommand("( trap '' HUP; '" ROBOSIM_PROGRAM "' run worlds/small_maze.xml --time 20 --record " +
                                 quoted(rawlog) + " & kill -HUP $!; wait $! )");
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

}  // namespace
}  // namespace robosim
