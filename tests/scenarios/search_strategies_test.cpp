// Every search strategy gives the same run in one process and over a network.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

const char* const kSearchWorld = "worlds/benchmark/gold_office_20.xml";
constexpr int kTime_s = 30;

class SearchStrategies : public testing::TestWithParam<std::string> {};

nlohmann::json runOf(const std::string& options) {
  const Ended run =
      runProgram(std::string("run ") + kSearchWorld + " --json --time " + std::to_string(kTime_s) + " " + options);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out);
}

TEST_P(SearchStrategies, GiveTheSameRunInOneProcessAndOverANetwork) {
  const auto in_one = runOf("--controller " + GetParam());
  ServedWorld::Options options;
  options.world = kSearchWorld;
  options.robots_elsewhere = true;
  options.last_step = in_one["steps"];
  ServedWorld world(options);
  const auto names = world.robotNames();
  std::vector<std::unique_ptr<StartedProgram>> robots;
  for (std::size_t first = 0; first < names.size(); first += 2) {
    std::vector<std::string> words{
        "robot",        names[first], names[first + 1], "--environment", world.connectOptions().address,
        "--controller", GetParam()};
    if (GetParam() == "oracle") words.insert(words.end(), {"--map", kSearchWorld});
    robots.push_back(std::make_unique<StartedProgram>(words));
  }
  EXPECT_EQ(world.wait(), Served::to_its_end);
  for (const auto& process : robots) EXPECT_EQ(process->wait().exit_code, 0) << process->error();
  EXPECT_EQ(world.digest(), in_one["digest"].get<std::string>());
}

TEST_P(SearchStrategies, GiveTheSameRunForAnyNumberOfThreadsAndInAReplay) {
  const std::filesystem::path log = testing::TempDir() + "strategy_" + GetParam() + ".rawlog";
  const auto run = runOf("--threads 1 --record " + quoted(log) + " --controller " + GetParam());
  EXPECT_EQ(run["digest"], runOf("--threads 3 --controller " + GetParam())["digest"]);
  const Ended replay = runProgram("replay " + quoted(log));
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
}

INSTANTIATE_TEST_SUITE_P(All, SearchStrategies,
                         testing::Values("random_walk", "levy_walk", "wall_search", "heat_gradient", "stigmergy",
                                         "gold_finder", "coordinated_frontiers", "market", "oracle"),
                         [](const auto& test) { return test.param; });

TEST(SearchStrategy, ThatKnowsTheWorldRequiresItsMapOverANetwork) {
  ServedWorld::Options options;
  options.world = kSearchWorld;
  options.robots_elsewhere = true;
  ServedWorld world(options);
  const auto robot = startRobots({world.robotNames().front()}, world.connectOptions().address, "oracle");
  EXPECT_NE(robot->wait().exit_code, 0);
  EXPECT_NE(robot->error().find("controller 'oracle' of robot 'Robot1' requires the map of the world and the robot's "
                                "start in it; give the world file by --map"),
            std::string::npos)
      << robot->error();
  world.end();
}

}  // namespace
}  // namespace robosim
