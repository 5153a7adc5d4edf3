#include "benchmark/sweep.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error_list.h"
#include "benchmark/runs_on_ranks.h"
#include "benchmark/search_runs.h"
#include "distributed/ranks/tasks_on_ranks.h"
#include "distributed/ranks/testing/thread_ranks.h"

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

Sweep smallSweep() {
  SweepPlan plan;
  plan.controllers = {"still", "wander"};
  plan.observers = {"coverage"};
  plan.runs = 3;
  plan.time_s = 2;
  return Sweep(plan, {ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml"}, {});
}

SearchRuns runsOf(
    const Sweep& sweep, int threads, const std::function<bool()>& is_interrupted = [] { return false; }) {
  SearchRuns runs(sweep.runCount());
  makeRuns(
      sweep, threads, is_interrupted, [](const SearchRun&) {}, runs);
  return runs;
}

TEST(Sweep, RunsEachControllerWithEachSeed) {
  const Sweep sweep = smallSweep();
  const SearchRuns runs = runsOf(sweep, 1);
  ASSERT_EQ(runs.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_TRUE(runs[i]);
    EXPECT_EQ(runs[i]->case_index, i / 3);
    EXPECT_EQ(runs[i]->seed, i % 3 + 1);
    EXPECT_NEAR(runs[i]->sim_time_s, 2, 1e-9);
    EXPECT_EQ(runs[i]->ended_by, "time_limit");
    EXPECT_EQ(runs[i]->metrics.size(), 2U);
  }
  EXPECT_EQ(runs[0]->driven_m, 0);
  EXPECT_GT(runs[3]->driven_m, 0);
  EXPECT_EQ(sweep.plan().caseAt(1).controller, 1U);
}

TEST(Sweep, GivesTheSameRunsForAnyNumberOfThreads) {
  const Sweep sweep = smallSweep();
  const SearchRuns one = runsOf(sweep, 1), three = runsOf(sweep, 3);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i]->json(), three[i]->json());
}

TEST(Sweep, GivesTheSameRunsOnRanks) {
  const Sweep sweep = smallSweep();
  const SearchRuns alone = runsOf(sweep, 1);
  SearchRuns runs(sweep.runCount());
  runThreadRanks(3, [&](RankGroup& group) {
    SearchRuns none;
    requireSamePlan(group, sweep.planText());
    makeRunsOnRanks(
        group, sweep, [] { return false; }, [](const SearchRun&) {}, group.isFirst() ? runs : none);
  });
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(alone[i]->json(), runs[i]->json());
}

TEST(Sweep, KeepsWhatWasCompletedWhenInterrupted) {
  int calls = 0;  // one per run and step: interrupted during the second run
  EXPECT_EQ(missing(runsOf(smallSweep(), 1, [&] { return ++calls > 30; })), (std::vector<std::size_t>{1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace robosim
