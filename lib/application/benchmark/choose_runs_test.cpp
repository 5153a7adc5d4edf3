#include <gtest/gtest.h>

#include "benchmark/search_report.h"

namespace robosim {
namespace {

/// A plan of two strategies with three runs each, and runs with these times to the gold [s]; below 0: not found.
SearchPlan twoStrategies() {
  SearchPlan plan;
  plan.worlds = {"maze"};
  plan.strategies = {"wander", "levy_walk exponent=2"};
  plan.runs = 3;
  return plan;
}

SearchRuns runsWith(const std::vector<double>& times_s) {
  SearchRuns runs;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    SearchRun run;
    run.case_index = i / 3;
    if (times_s[i] >= 0) run.found_s = times_s[i];
    runs.emplace_back(run);
  }
  return runs;
}

std::vector<std::size_t> indices(const std::vector<RunPageLink>& links) {
  std::vector<std::size_t> runs;
  for (const auto& link : links) runs.push_back(link.run);
  return runs;
}

TEST(ChooseRuns, TakesTheFastestAndAFailureOrTheSlowestOfEachStrategy) {
  const auto links = chooseRuns(twoStrategies(), runsWith({30, -1, 20, 5, 9, 7}), 2);
  EXPECT_EQ(indices(links), (std::vector<std::size_t>{2, 1, 3, 4}));
  EXPECT_EQ(links[0].file, "runs/wander-2.html");
  EXPECT_EQ(links[2].file, "runs/levy_walk_exponent_2-3.html");
}

TEST(ChooseRuns, TakesTheFastestOrAllOrNone) {
  const auto runs = runsWith({30, -1, 20, 5, 9, 7});
  EXPECT_EQ(indices(chooseRuns(twoStrategies(), runs, 1)), (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(indices(chooseRuns(twoStrategies(), runs, 9)), (std::vector<std::size_t>{2, 0, 1, 3, 5, 4}));
  EXPECT_TRUE(chooseRuns(twoStrategies(), runs, 0).empty());
}

}  // namespace
}  // namespace robosim
