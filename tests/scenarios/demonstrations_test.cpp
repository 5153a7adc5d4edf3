// The shipped worlds in which robots move things, as doc/tutorials shows them: what their controllers achieve.
#include <cmath>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

using Json = nlohmann::json;

Json runOf(const std::string& arguments) {
  const Ended run = runProgram("run " + arguments + " --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return Json::parse(run.out);
}

TEST(Foraging, BringsAllPucksToTheNest) {
  for (const char* seed : {"1", "2", "3"}) {
    const Json run = runOf("foraging --observer \"collection end_percent=100\" --time 600 --seed " + std::string(seed));
    EXPECT_EQ(run["metrics"]["collection.collected"], 40) << seed;
    EXPECT_LT(run["metrics"]["collection.half_collected_s"], 90) << seed;
    EXPECT_EQ(run["ended_by"], "observer") << seed;
  }
}

TEST(Foraging, IsComparedByBenchMetrics) {
  const auto csv = emptyFolder() / "runs.csv";
  const Ended bench = runProgram(
      "bench metrics foraging --observer collection --runs 2 --time 60 --controller "
      "\"forage speed_mps=0.25,0.5\" --csv " +
      quoted(csv));
  EXPECT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_NE(bench.out.find("collection.collected_percent"), std::string::npos) << bench.out;
  EXPECT_NE(textOf(csv).find("collection.half_collected_s"), std::string::npos);
}

TEST(CarryGold, BringsAllGoldHome) {
  for (const char* seed : {"1", "2", "3"}) {
    const Json run =
        runOf("carry_gold --observer \"collection end_percent=100\" --time 600 --seed " + std::string(seed));
    EXPECT_EQ(run["metrics"]["collection.collected"], 10) << seed;
    EXPECT_LT(run["metrics"]["collection.all_collected_s"], 200) << seed;
  }
}

TEST(CarryGold, IsRepeatedFromItsRecording) {
  const auto rawlog = emptyFolder() / "gold.rawlog";
  runOf("carry_gold --time 60 --record " + quoted(rawlog));
  const Ended check = runProgram("replay --check carry_gold " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST(Soccer, HasGoalsOfBothTeamsInThreeGames) {
  double east = 0, west = 0;
  for (const char* seed : {"1", "2", "3"}) {
    const Json run = runOf("soccer --observer soccer --time 300 --seed " + std::string(seed));
    const double goals_east = run["metrics"]["soccer.goals_east"], goals_west = run["metrics"]["soccer.goals_west"];
    EXPECT_GE(goals_east + goals_west, 1) << seed;
    EXPECT_GE(run["interventions"], 7 * (goals_east + goals_west)) << seed << ": a kick-off places the ball and robots";
    east += goals_east;
    west += goals_west;
  }
  EXPECT_GE(east, 1);
  EXPECT_GE(west, 1);
}

TEST(Soccer, IsRepeatedFromItsRecordingWithTheKickOffs) {
  const auto rawlog = emptyFolder() / "game.rawlog";
  const Json run = runOf("soccer --observer \"soccer goals=1\" --time 300 --record " + quoted(rawlog));
  EXPECT_EQ(run["ended_by"], "intervention");
  const std::string outcome = run["end_outcome"];
  EXPECT_TRUE(outcome == "west_team_won" || outcome == "east_team_won") << outcome;
  const Ended check = runProgram("replay --check soccer " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

/// A copy of a shipped world in which text is replaced.
std::filesystem::path changedWorld(const std::string& name, const std::string& pattern, const std::string& by) {
  const auto file = emptyFolder() / (name + ".xml");
  const std::string text = textOf(ROBOSIM_SOURCE_DIR "/worlds/" + name + ".xml");
  const std::string changed = std::regex_replace(text, std::regex(pattern), by);
  EXPECT_NE(changed, text);
  std::ofstream(file) << changed;
  return file;
}

const std::string kCrateInPlace = " --observer \"collection x_m=3.5 radius_m=0.1\" --time 60";

TEST(PushBox, MovesTheCrateByTwoRobots) {
  const Json run = runOf("push_box" + kCrateInPlace);
  EXPECT_EQ(run["ended_by"], "all_halted");
  EXPECT_EQ(run["metrics"]["collection.collected"], 1) << "2.5 m from its start";
}

TEST(PushBox, WaitsForTheSecondRobot) {
  const auto world = changedWorld("push_box", "</surface>", R"(</surface><at time="0"><remove name="Right"/></at>)");
  const Json run = runOf(quoted(world) + kCrateInPlace);
  EXPECT_EQ(run["ended_by"], "time_limit");
  EXPECT_EQ(run["stalls"], 0) << "it does not push";
}

TEST(PushBox, IsTooHeavyForOneRobot) {
  const auto middle =
      changedWorld("push_box", R"(<y>0\.4</y> (<controller name="push_together"))", "<y>0</y> $1 team=\"1\"");
  std::ofstream(middle.parent_path() / "one.xml") << std::regex_replace(
      textOf(middle), std::regex("</surface>"), R"(</surface><at time="0"><remove name="Right"/></at>)");
  const Json run =
      runOf(quoted(middle.parent_path() / "one.xml") + " --observer \"collection x_m=1 radius_m=0.01\" --time 60");
  EXPECT_GT(run["stalls"], 400) << "as at a wall";
  EXPECT_EQ(run["metrics"]["collection.collected"], 1) << "the crate is at its start";
}

TEST(HeldDoor, LetsTheGuestPass) {
  EXPECT_EQ(runOf("held_door --time 60")["ended_by"], "all_halted") << "the guest halts behind the door";
}

TEST(HeldDoor, IsClosedBeforeTheGuestArrivesIfNoRobotStandsInIt) {
  const auto world = changedWorld("held_door", R"(x_m="0" y_m="0\.25")", R"(x_m="-0.6" y_m="0.25")");
  const Json run = runOf(quoted(world) + " --time 60");
  EXPECT_EQ(run["ended_by"], "time_limit");
  EXPECT_GT(run["stalls"], 200) << "the guest stands before the door";
}

}  // namespace
}  // namespace robosim
