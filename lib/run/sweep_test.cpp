#include "run/sweep.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(ExpandedChoices, AreAllCombinationsOfTheValuesInOrder) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(expandedChoices("wander"), Texts{"wander"});
  EXPECT_EQ(expandedChoices("flocking a=1,2 b=3,4"),
            (Texts{"flocking a=1 b=3", "flocking a=1 b=4", "flocking a=2 b=3", "flocking a=2 b=4"}));
  std::string many = "flocking";
  for (const char* name : {"a", "b", "c", "d", "e"}) many += std::string(" ") + name + "=1,2,3,4,5,6,7,8,9,10";
  EXPECT_THROW(expandedChoices(many), ConfigError);
}

std::vector<SweepGroup> sweepOf(
    int threads, const std::function<bool()>& is_interrupted = [] { return false; }) {
  const std::vector<LoadedWorld> worlds{loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", "still")};
  SweepOptions options;
  options.controllers = {"still", "wander"};
  options.observers = {"coverage"};
  options.runs = 3;
  options.time_s = 2;
  options.threads = threads;
  return sweep(worlds, options, is_interrupted, [](std::size_t) {});
}

TEST(Sweep, RunsEachControllerWithEachSeed) {
  const auto groups = sweepOf(1);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].controller, "still");
  EXPECT_EQ(groups[1].controller, "wander");
  for (const auto& group : groups) {
    ASSERT_EQ(group.runs.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(group.runs[i].seed, i + 1);
      EXPECT_EQ(group.runs[i].steps, 20U);
      EXPECT_EQ(group.runs[i].metrics.size(), 2U);
    }
  }
  EXPECT_EQ(groups[0].runs[0].driven_m, 0);
  EXPECT_GT(groups[1].runs[0].driven_m, 0);
}

TEST(Sweep, GivesTheSameRunsForAnyNumberOfThreads) {
  const auto one = sweepOf(1), three = sweepOf(3);
  for (std::size_t g = 0; g < one.size(); ++g) {
    for (std::size_t i = 0; i < one[g].runs.size(); ++i) EXPECT_EQ(one[g].runs[i].digest, three[g].runs[i].digest);
  }
}

TEST(Sweep, ReturnsWhatWasCompletedWhenInterrupted) {
  int calls = 0;
  const auto groups = sweepOf(1, [&] { return ++calls > 30; });  // one call per run and step: during the second run
  EXPECT_EQ(groups[0].runs.size(), 1U);
  EXPECT_EQ(groups[1].runs.size(), 0U);
}

}  // namespace
}  // namespace robosim
