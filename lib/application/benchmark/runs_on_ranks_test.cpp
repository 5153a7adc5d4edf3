#include "benchmark/runs_on_ranks.h"

#include <atomic>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error_list.h"
#include "benchmark/search_benchmark.h"
#include "distributed/ranks/tasks_on_ranks.h"
#include "distributed/ranks/testing/thread_ranks.h"

namespace robosim {
namespace {

SearchBenchmark smallBenchmark() {
  SearchPlan plan;
  plan.strategies = {"wander", "gold_finder"};
  plan.runs = 6;
  plan.time_s = 20;
  return SearchBenchmark(plan, {ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml"}, {});
}

std::vector<std::string> textsOf(const SearchRuns& runs) {
  std::vector<std::string> texts;
  for (const auto& run : runs) texts.push_back(run ? run->json().dump() : "missing");
  return texts;
}

const auto kNever = [] { return false; };

TEST(RunsOnRanks, EqualThoseOfOneProcess) {
  const SearchBenchmark benchmark = smallBenchmark();
  SearchRuns alone(benchmark.plan().runCount());
  makeRuns(
      benchmark, 1, kNever, [](const SearchRun&) {}, alone);
  EXPECT_TRUE(missing(alone).empty());
  for (const int ranks : {2, 3, 5}) {
    SearchRuns runs(benchmark.plan().runCount());
    runs[3] = alone[3];  // one is known already
    std::size_t finished = 0;
    runThreadRanks(ranks, [&](RankGroup& group) {
      SearchRuns none;
      makeRunsOnRanks(
          group, benchmark, kNever, [&](const SearchRun&) { ++finished; }, group.isFirst() ? runs : none);
    });
    EXPECT_EQ(textsOf(runs), textsOf(alone)) << ranks;
    EXPECT_EQ(finished, runs.size() - 1);
  }
}

TEST(RunsOnRanks, EndWithTheErrorOfARank) {
  const SearchBenchmark benchmark = smallBenchmark();
  for (const int failing : {0, 2}) {
    std::atomic<int> errors = 0;
    try {
      runThreadRanks(3, [&](RankGroup& group) {
        SearchRuns runs(benchmark.plan().runCount()), none;
        const auto check = [&]() -> bool {
          if (group.rank() == failing) throw ConfigError("the disk of this rank is wet");
          return false;
        };
        try {
          makeRunsOnRanks(
              group, benchmark, check, [](const SearchRun&) {}, group.isFirst() ? runs : none);
        } catch (...) {
          ++errors;
          throw;
        }
      });
      ADD_FAILURE() << failing;
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find("the disk of this rank is wet"), std::string::npos);
    }
    EXPECT_EQ(errors, 3);
  }
}

TEST(RunsOnRanks, EndWhenOneRankIsInterruptedAfterItsLastRun) {
  const SearchBenchmark benchmark = smallBenchmark();
  SearchRuns runs(benchmark.plan().runCount());
  std::atomic<int> finished = 0;
  const int all = static_cast<int>(runs.size());
  runThreadRanks(3, [&](RankGroup& group) {
    SearchRuns none;
    makeRunsOnRanks(
        group, benchmark, [&] { return group.rank() == 2 && finished >= all - 2; },
        [&](const SearchRun&) { ++finished; }, group.isFirst() ? runs : none);
  });
  EXPECT_GE(finished, all - 2);
}

TEST(RunsOnRanks, NeedTheSamePlanOnAllRanks) {
  std::atomic<int> errors = 0;
  EXPECT_THROW(runThreadRanks(3,
                              [&](RankGroup& group) {
                                SearchPlan plan = smallBenchmark().plan();
                                if (group.rank() == 1) plan.time_s = 21;
                                try {
                                  requireSamePlan(group, plan.json().dump());
                                } catch (const ConfigError& error) {
                                  EXPECT_NE(std::string(error.what()).find("another plan than rank 0"),
                                            std::string::npos);
                                  ++errors;
                                  throw;
                                }
                              }),
               ConfigError);
  EXPECT_EQ(errors, 3);
}

TEST(RunsOnRanks, KeepWhatIsFinishedWhenInterrupted) {
  const SearchBenchmark benchmark = smallBenchmark();
  SearchRuns alone(benchmark.plan().runCount()), runs(benchmark.plan().runCount());
  makeRuns(
      benchmark, 1, kNever, [](const SearchRun&) {}, alone);
  std::atomic<int> finished = 0;
  runThreadRanks(3, [&](RankGroup& group) {
    SearchRuns none;
    makeRunsOnRanks(
        group, benchmark, [&] { return finished >= 4; }, [&](const SearchRun&) { ++finished; },
        group.isFirst() ? runs : none);
  });
  std::size_t made = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i]) continue;
    ++made;
    EXPECT_EQ(runs[i]->json(), alone[i]->json());
  }
  EXPECT_EQ(made, static_cast<std::size_t>(finished));
  EXPECT_GE(made, 4u);
  EXPECT_LT(made, runs.size());
}

}  // namespace
}  // namespace robosim
