// `robosim replay --observer`: the metrics of a recorded run.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

using nlohmann::json;

TEST(ReplayObserver, ReportsTheMetricsOfTheRecordedRun) {
  const auto rawlog = quoted(emptyFolder() / "run.rawlog");
  const Ended run = runProgram(
      "run worlds/opho2_1.xml --controller wander --time 30 --seed 3 --random-starts --json --observer 'coverage "
      "cell_m=0.25' --record " +
      rawlog);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json metrics = json::parse(run.out)["metrics"];
  EXPECT_GT(metrics["coverage.covered_percent"], 0);
  const Ended replay = runProgram("replay " + rawlog + " --json --observer 'coverage cell_m=0.25'");
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_EQ(json::parse(replay.out)["metrics"], metrics);
  EXPECT_TRUE(replay.err.starts_with("The same run: 300 steps")) << replay.err;
}

TEST(ReplayObserver, PrintsMetricsBelowTheVerdict) {
  const auto rawlog = quoted(emptyFolder() / "run.rawlog");
  ASSERT_EQ(runProgram("run worlds/small_maze.xml --time 5 --record " + rawlog).exit_code, 0);
  const Ended replay = runProgram("replay " + rawlog + " --observer 'coverage end_percent=0.1'");
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_TRUE(replay.out.starts_with("The same run: 50 steps")) << "the observer does not end it: " << replay.out;
  EXPECT_NE(replay.out.find("\ncoverage.covered_percent "), std::string::npos) << replay.out;
}

TEST(ReplayObserver, ReportsNoMetricsOfAnotherRun) {
  const auto folder = emptyFolder();
  const auto rawlog = quoted(folder / "run.rawlog");
  ASSERT_EQ(runProgram("run worlds/opho2_1.xml --time 100 --record " + rawlog).exit_code, 0);
  std::string hotter = textOf(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml");
  const auto at = hotter.find("<hot>20");
  ASSERT_NE(at, std::string::npos);
  hotter.replace(at, 7, "<hot>21");
  std::ofstream(folder / "hotter.xml") << hotter;
  const Ended other =
      runProgram("replay " + rawlog + " --observer coverage --json --check " + quoted(folder / "hotter.xml"));
  EXPECT_EQ(other.exit_code, 2) << other.err;
  EXPECT_EQ(other.out, "");
  EXPECT_NE(other.err.find("Not the same run. It first differs in step "), std::string::npos) << other.err;
}

TEST(ReplayObserver, RequiresARecordingOfRoboSim) {
  const auto rawlog = emptyFolder() / "foreign.rawlog";
  writeForeignRawlog(rawlog);
  const Ended other = runProgram("replay " + quoted(rawlog) + " --observer coverage");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("contains no world, because it was not recorded by RoboSim"), std::string::npos)
      << other.err;
  const Ended json_only = runProgram("replay " + quoted(rawlog) + " --check worlds/small_maze.xml --json");
  EXPECT_EQ(json_only.exit_code, 1);
  EXPECT_NE(json_only.err.find("add an --observer"), std::string::npos) << json_only.err;
}

}  // namespace
}  // namespace robosim
