// `robosim run` from the command line.

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/program.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using nlohmann::json;

TEST(Run, FindsAndReportsTheGoldInTheSmallMaze) {
  const Ended run = runProgram("run worlds/small_maze.xml");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("gold found by "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("digest"), std::string::npos);
  EXPECT_EQ(run.err, "") << "no progress line in a pipe";
}

TEST(Run, PrintsACompleteJsonObject) {
  const Ended run = runProgram("run worlds/small_maze.xml --json --seed 3");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json summary = json::parse(run.out);
  for (const char* key : {"world", "seed", "robots", "steps", "sim_time_s", "wall_s", "real_time_factor", "digest",
                          "gold_found", "gold_found_by", "gold_time_s", "all_halted_time_s", "stalls", "messages"}) {
    EXPECT_TRUE(summary.contains(key)) << key;
  }
  EXPECT_EQ(summary["seed"], 3);
  EXPECT_EQ(summary["robots"], 2);
  EXPECT_EQ(summary["gold_found"], true);
  EXPECT_GE(summary["all_halted_time_s"].get<double>(), summary["gold_time_s"].get<double>());
  EXPECT_DOUBLE_EQ(summary["sim_time_s"].get<double>(), summary["steps"].get<double>() * 0.1);
  EXPECT_GE(summary["messages"].get<int>(), 1) << "GOLD goes round the ring";
}

TEST(Run, IsIdenticalForEqualSeedsThreadsAndRecording) {
  const auto folder = emptyFolder();
  const auto digest = [](const std::string& arguments) {
    return json::parse(
        runProgram("run worlds/small_maze.xml --json --time 60 --controller wander " + arguments).out)["digest"];
  };
  const auto one = digest("--seed 5");
  EXPECT_EQ(digest("--seed 5 --threads 2"), one);
  EXPECT_EQ(digest("--seed 5 --record '" + (folder / "run.rawlog").string() + "'"), one);
  EXPECT_NE(digest("--seed 6"), one);
}

TEST(Run, AppliesTimeLimitControllerAndStep) {
  const json summary =
      json::parse(runProgram("run worlds/small_maze.xml --json --controller still --time 10 --step 0.05").out);
  EXPECT_EQ(summary["steps"], 200);
  EXPECT_EQ(summary["ended_by"], "time_limit");
  EXPECT_EQ(summary["gold_found"], false);
  EXPECT_TRUE(summary["gold_time_s"].is_null());
  EXPECT_EQ(summary["driven_m"], 0);
}

TEST(Run, RunsAWorldOf2005) {
  const Ended run = runProgram("run tests/data/legacy_world.xml --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(json::parse(run.out)["gold_found_by"], "Finder1");
}

TEST(Run, WritesARawlogForRawlogEditAndAPicture) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  const auto picture = folder / "run.png";
  const Ended run = runProgram("run worlds/small_maze.xml --time 20 --record '" + rawlog.string() + "' --picture '" +
                               picture.string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(textOf(picture).substr(0, 4), "\x89PNG");
  EXPECT_FALSE(std::filesystem::exists(rawlog.string() + ".part"));
  const ToolRun tool = runTool("rawlog-edit --info -i run.rawlog", folder);
  EXPECT_EQ(tool.exit_code, 0) << tool.output;
  for (const char* name : {"Pioneer1/sonar", "Scout1/odometry", "Scout1/GROUND_TRUTH"}) {
    EXPECT_NE(tool.output.find(name), std::string::npos) << name << "\n" << tool.output;
  }
}

TEST(Run, LeavesAReadableRawlogWhenInterrupted) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  // At real time the run would take half an hour. It is interrupted after its recording has been opened.
  StartedProgram run({"run", "worlds/small_maze.xml", "--json", "--speed", "1", "--controller", "wander", "--record",
                      rawlog.string()});
  run.waitForFile(rawlog.string() + ".part");
  run.interrupt();
  const Ended ended = run.wait();
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  EXPECT_EQ(json::parse(ended.out)["ended_by"], "interrupted");
  EXPECT_TRUE(std::filesystem::exists(rawlog));
  EXPECT_FALSE(std::filesystem::exists(rawlog.string() + ".part"));
  EXPECT_EQ(runTool("rawlog-edit --info -i run.rawlog", folder).exit_code, 0);
}

struct Mistake {
  const char* arguments;
  const char* complaint;
};

TEST(Run, RejectsBadInputWithCode1AndAnErrorText) {
  const Mistake mistakes[] = {
      {"run no_such_world.xml", "no_such_world.xml: no such file; check the path; searched are also "},
      {"run worlds", "worlds: is a directory; name a file in it"},
      {"run LICENSE", "LICENSE:1: "},
      {"run", "WORLD is required"},
      {"run worlds/small_maze.xml --controller bogus", "bogus"},
      {"run worlds/small_maze.xml --step 0", "--step"},
      {"run worlds/small_maze.xml --time -5", "--time"},
      {"run worlds/small_maze.xml --step nan", "--step: nan: must be a number in [0.001, 1]"},
      {"run worlds/small_maze.xml --time nan", "--time: nan: must be a number in [0.001, 1e+09]"},
      {"run worlds/small_maze.xml --time inf", "--time"},
      {"run worlds/small_maze.xml --seed -1", "--seed: -1: must be a whole number"},
      {"run worlds/small_maze.xml --seed 99999999999999999999", "--seed"},
      {"run worlds/small_maze.xml --record ''", "--record"},
      {"run worlds/small_maze.xml --record worlds/../worlds/small_maze.xml", "is both WORLD and --record"},
      {"run worlds/small_maze.xml --record /tmp/robosim_same.png --picture /tmp/robosim_same.png", "--picture"},
      {"bench gold worlds/small_maze.xml --csv worlds/small_maze.xml",
       "worlds/small_maze.xml: would replace worlds/small_maze.xml, which this command reads"},
      {"bench gold worlds/small_maze.xml --time nan", "--time"},
      {"run worlds/small_maze.xml --threads 0", "--threads"},
      {"run worlds/small_maze.xml --speed fast", "--speed fast: must be 'max' or a number"},
      {"run worlds/small_maze.xml --record /no/such/folder/x.rawlog", "/no/such/folder"},
      {"run worlds/small_maze.xml --picture /no/such/folder/x.png", "/no/such/folder"},
      {"run worlds/small_maze.xml --bogus", "--bogus"},
      {"bogus", "bogus"},
      {"", "subcommand"},
  };
  for (const auto& mistake : mistakes) {
    const Ended run = runProgram(mistake.arguments);
    EXPECT_EQ(run.exit_code, 1) << mistake.arguments;
    EXPECT_NE(run.err.find(mistake.complaint), std::string::npos) << mistake.arguments << "\n" << run.err;
    EXPECT_EQ(run.out, "") << mistake.arguments;
  }
}

TEST(Run, EndsOnInterruptAtVeryLowSpeed) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  StartedProgram run({"run", "worlds/small_maze.xml", "--json", "--speed", "0.001", "--controller", "wander",
                      "--record", rawlog.string()});
  run.waitForFile(rawlog.string() + ".part");
  run.interrupt();
  EXPECT_EQ(json::parse(run.wait().out)["ended_by"], "interrupted");
}

TEST(Run, KeepsAnExistingRawlogWhenAControllerIsUnsuitable) {
  const auto folder = emptyFolder();
  std::ofstream(folder / "blind.xml") << R"(<world><surface>
    <size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size>
    <object><shape><robot><cylinder>
      <name>Blind</name><x>0</x><y>0</y><z>1</z><radius>1</radius><height>2</height>
    </cylinder></robot></shape></object>
  </surface></world>)";
  std::ofstream(folder / "old.rawlog") << "old";
  const Ended run =
      runProgram("run '" + (folder / "blind.xml").string() + "' --record '" + (folder / "old.rawlog").string() + "'");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("blind.xml:3: robot 'Blind': its controller gold_finder requires a sensor of kind heat"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(textOf(folder / "old.rawlog"), "old");
}

TEST(Run, FailsWithCode2WhenItsSummaryCannotBeWritten) {
  const Ended run = runProgram("run worlds/small_maze.xml --time 1 --json", "/dev/full");
  EXPECT_EQ(run.exit_code, 2) << run.err;
}

TEST(Run, FailsWithCode2AndLeavesNoHalfWrittenRawlogWhenTheDiskIsFull) {
  const auto folder = emptyFolder();
  // A limit on the size of files replaces the full disk: the write fails in the same way.
  const std::string rawlog = (folder / "run.rawlog").string();
  const int status = std::system(("bash -c \"ulimit -f 8; trap '' XFSZ; cd '" ROBOSIM_SOURCE_DIR "'; '" ROBOSIM_PROGRAM
                                  "' run worlds/open_100.xml --time 60 --record '" +
                                  rawlog + "' >/dev/null 2>'" + (folder / "err").string() + "'\"")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(textOf(folder / "err").find("run.rawlog"), std::string::npos) << textOf(folder / "err");
  EXPECT_FALSE(std::filesystem::exists(rawlog));
}

}  // namespace
}  // namespace robosim
