// `robosim replay` on recordings of our own, damaged ones, and somebody else's.

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/program.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

using nlohmann::json;

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// Runs a world, recorded. @return the summary
json record(const std::string& arguments, const std::filesystem::path& file) {
  const Ended run = runProgram("run " + arguments + " --json --record " + quoted(file));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out);
}

TEST(Replay, SummarisesWhatTheRobotsSensedAndHowTheRunEnded) {
  const auto file = emptyFolder() / "run.rawlog";
  const json run = record("worlds/small_maze.xml --seed 3", file);
  const Ended replay = runProgram("replay --json " + quoted(file));
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  const json summary = json::parse(replay.out);
  EXPECT_EQ(summary["whole"], true);
  EXPECT_EQ(summary["run"]["world"], "small_maze.xml");
  EXPECT_EQ(summary["run"]["seed"], 3);
  EXPECT_EQ(summary["run"]["outcome"]["digest"], run["digest"]);
  EXPECT_EQ(summary["run"]["outcome"]["gold_found_by"], run["gold_found_by"]);
  EXPECT_NEAR(summary["duration_s"].get<double>(), run["sim_time_s"].get<double>(), 1e-9);
  double driven_m = 0;
  for (const auto& robot : summary["driven_m"]) driven_m += robot.get<double>();
  EXPECT_NEAR(driven_m, run["driven_m"].get<double>(), 0.01 * driven_m) << "chords are a little shorter than arcs";
  const std::uint64_t steps = run["steps"].get<std::uint64_t>() + 1;
  std::uint64_t sonars = 0;
  for (const auto& channel : summary["channels"]) {
    const std::string label = channel["label"];
    if (!label.ends_with("/sonar")) continue;
    ++sonars;
    EXPECT_EQ(channel["class"], "CObservationRange");
    EXPECT_EQ(channel["count"], steps);
    EXPECT_NEAR(channel["rate_hz"].get<double>(), 10, 1e-6);
  }
  EXPECT_EQ(sonars, 2U);
}

TEST(Replay, ShowsOnlyTheRobotsSensorsAndTimesAskedFor) {
  const auto file = emptyFolder() / "run.rawlog";
  record("worlds/opho2_1.xml --time 5", file);
  const Ended one = runProgram("replay --print --robot Finder2 --sensor heat --from 1 --to 1.2 " + quoted(file));
  EXPECT_EQ(countOf("\n", one.out), 3U) << one.out;
  EXPECT_EQ(countOf("Finder2/heat", one.out), 3U) << one.out;
  EXPECT_EQ(one.out.rfind("1.000 s  Finder2/heat", 0), 0U) << one.out;
}

TEST(Replay, RunsTheWorldAgainAndItIsTheSameRun) {
  const auto file = emptyFolder() / "run.rawlog";
  const json run = record("worlds/opho2_1.xml --seed 4 --time 60", file);
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_EQ(check.out, "The same run: 601 steps, digest " + run["digest"].get<std::string>() + "\n");
}

TEST(Replay, TellsTheFirstStepAndReadingThatDifferInAChangedWorld) {
  const auto folder = emptyFolder();
  record("worlds/opho2_1.xml --time 100", folder / "run.rawlog");
  std::string text = textOf(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml");
  const auto at = text.find("<hot>20");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 7, "<hot>21");
  std::ofstream(folder / "hotter.xml") << text;
  const Ended check =
      runProgram("replay --check " + quoted(folder / "hotter.xml") + " " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(check.exit_code, 2) << check.out << check.err;
  EXPECT_NE(check.out.find("The world has changed"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find("Not the same run. It first differs in step "), std::string::npos) << check.out;
  EXPECT_NE(check.out.find(", heat, value: recorded "), std::string::npos) << check.out;
}

TEST(Replay, AControllerDecidesOnRecordedReadingsAsItDidThen) {
  const auto file = emptyFolder() / "run.rawlog";
  // Sector sonars, whose echoes come from beside their axes, and mail: both come back to the last bit.
  record("worlds/opho2_1.xml", file);
  const Ended same = runProgram("replay --controller recorded " + quoted(file));
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(countOf("commands are the recorded ones", same.out), 4U) << same.out;
  const Ended other = runProgram("replay --controller wander --robot Finder1 " + quoted(file));
  EXPECT_EQ(countOf("commands differ", other.out), 1U) << other.out;
  EXPECT_NE(other.out.find("first in step 1 (0.100 s): recorded "), std::string::npos) << other.out;
}

TEST(Replay, OfARecordingThatIsCutOffChecksWhatThereIs) {
  const auto file = emptyFolder() / "run.rawlog";
  record("worlds/opho2_1.xml --time 40", file);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_NE(check.out.find("it is cut off"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find(" steps, is the same."), std::string::npos) << check.out;
  const Ended summary = runProgram("replay " + quoted(file));
  EXPECT_EQ(summary.exit_code, 0);
  EXPECT_NE(summary.out.find("ends early, after "), std::string::npos) << summary.out;
}

TEST(Replay, SummarisesSomebodyElsesRecording) {
  const auto file = emptyFolder() / "foreign.rawlog";
  writeForeignRawlog(file);
  const json summary = json::parse(runProgram("replay --json " + quoted(file)).out);
  EXPECT_EQ(summary["observations"], 100);
  EXPECT_NEAR(summary["duration_s"].get<double>(), 9.8, 1e-6);
  EXPECT_NEAR(summary["driven_m"][""].get<double>(), 4.9, 1e-9);
  EXPECT_FALSE(summary.contains("run"));
  const Ended check = runProgram("replay --check worlds/opho2_1.xml " + quoted(file));
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.err.find("does not say which world it is of"), std::string::npos) << check.err;
}

TEST(Replay, RefusesWhatIsNoRecordingAndAnotherWorld) {
  const auto folder = emptyFolder();
  const Ended world = runProgram("replay worlds/small_maze.xml");
  EXPECT_EQ(world.exit_code, 1);
  EXPECT_NE(world.err.find("is no MRPT rawlog"), std::string::npos) << world.err;
  EXPECT_NE(runProgram("replay none.rawlog").err.find("No such file"), std::string::npos);
  record("worlds/opho2_1.xml --time 1", folder / "run.rawlog");
  const Ended other = runProgram("replay --check worlds/small_maze.xml " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("has 2 robots, and the recording 4"), std::string::npos) << other.err;
}

TEST(Replay, TheSameRunIsTheSameRecordingByteForByte) {
  const auto folder = emptyFolder();
  for (const char* name : {"one.rawlog", "two.rawlog"}) record("worlds/small_maze.xml --time 20", folder / name);
  EXPECT_EQ(textOf(folder / "one.rawlog"), textOf(folder / "two.rawlog"));
}

}  // namespace
}  // namespace robosim
