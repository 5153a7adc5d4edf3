// The worlds of the gold benchmark: they are what worlds/benchmark/make.sh generates, have gold that can be reached,
// and give the digests in tests/data/gold_worlds.json. After a change that is meant to change runs, run this test with
// ROBOSIM_GOLDEN_UPDATE=1.
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/temporary_directory.h"
#include "environment/world_changes.h"
#include "robots/world_source.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const fs::path kFolder = ROBOSIM_SOURCE_DIR "/worlds/benchmark";
const fs::path kDigests = ROBOSIM_SOURCE_DIR "/tests/data/gold_worlds.json";

std::vector<std::string> goldWorlds() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".xml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The JSON summary of a run of a world, found by its name in another folder.
Json runOf(const std::string& world, const std::string& options) {
  const Ended run = runCommand("cd / && '" ROBOSIM_PROGRAM "' run " + world + " --json " + options);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.exit_code == 0 ? Json::parse(run.out) : Json();
}

TEST(GoldWorlds, AreThoseThatTheirScriptGenerates) {
  const TemporaryDirectory folder;
  const Ended made = runCommand(quoted(kFolder / "make.sh") + " " + quoted(folder.path()) + " '" ROBOSIM_PROGRAM "'");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(goldWorlds().size(), 12u);
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    ++count;
    EXPECT_EQ(textOf(entry.path()), textOf(kFolder / entry.path().filename())) << entry.path();
  }
  EXPECT_EQ(count, 12u);
}

class GoldWorld : public testing::TestWithParam<std::string> {};

TEST_P(GoldWorld, HasGoldThatRobotsReach) {
  const Json run = runOf(GetParam(), "--controller oracle --time 600");
  EXPECT_TRUE(run["gold_found"].get<bool>());
  EXPECT_EQ(run["robots"], 4);
}

TEST_P(GoldWorld, HasRoomFor64RobotsInARingOfNeighbours) {
  WorldChanges changes;
  changes.random_robots = 60;
  const LoadedWorld world =
      loadWorld(withChanges(readWorldSource(kFolder / (GetParam() + ".xml")), changes, 1), nullptr);
  const auto& robots = world.fleet.robots;
  ASSERT_EQ(robots.size(), 64u);
  std::size_t robot = 0, steps = 0;
  do {
    const auto next = std::find_if(robots.begin(), robots.end(), [&](const FleetRobot& other) {
      return other.info.name == robots[robot].info.neighbour;
    });
    ASSERT_NE(next, robots.end()) << robots[robot].info.name;
    robot = static_cast<std::size_t>(next - robots.begin());
    ++steps;
  } while (robot != 0 && steps < robots.size());
  EXPECT_EQ(steps, robots.size());
}

TEST_P(GoldWorld, ReproducesTheKeptDigest) {
  const std::string digest = runOf(GetParam(), "--controller gold_finder --time 60 --seed 1")["digest"];
  Json kept = fs::exists(kDigests) ? Json::parse(textOf(kDigests)) : Json::object();
  if (std::getenv("ROBOSIM_GOLDEN_UPDATE") != nullptr) {
    kept[GetParam()] = digest;
    std::ofstream(kDigests) << kept.dump(2) << '\n';
    return;
  }
  EXPECT_EQ(kept.value(GetParam(), ""), digest);
}

INSTANTIATE_TEST_SUITE_P(All, GoldWorld, testing::ValuesIn(goldWorlds()), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace robosim
