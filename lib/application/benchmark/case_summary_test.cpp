#include "benchmark/case_summary.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// One world, strategies oracle and wander, teams of 1 and 4, conditions ideal and noise, four starts.
class CaseSummaryTest : public testing::Test {
 protected:
  CaseSummaryTest() {
    plan_.worlds = {"maze"};
    plan_.strategies = {"oracle", "wander"};
    plan_.teams = {1, 4};
    plan_.conditions = {Condition{}, Condition::parse("noise")};
    plan_.runs = 4;
    plan_.time_s = 100;
    runs_.resize(plan_.runCount());
    set({0, 0, 0, 0}, {2, 4, 5, 10});
    set({0, 0, 0, 1}, {4, 20, -1, 30});
    set({0, 0, 1, 0}, {1, 2, 2, 2});
    set({0, 0, 1, 1}, {4, 2, 10, 8});
    set({0, 1, 0, 1}, {8, 40, -1, -1});
  }
  /// @param times negative: not found
  void set(const SearchPlan::Case& c, const std::vector<double>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      SearchRun run;
      run.case_index = plan_.indexOf(c);
      run.seed = 1 + i;
      run.sim_time_s = times[i] < 0 ? 100 : times[i];
      if (times[i] >= 0) run.found_s = times[i];
      run.driven_m = static_cast<double>(i);
      run.metrics = {{kEnergyMetric, 2.0 * static_cast<double>(i)}};
      runs_[run.case_index * plan_.runs + i] = run;
    }
  }
  const CaseSummary& of(const SearchPlan::Case& c) {
    summaries_ = summarise(plan_, runs_);
    for (const auto& summary : summaries_) {
      if (summary.of == c) return summary;
    }
    throw std::logic_error("no runs");
  }

  SearchPlan plan_;
  SearchRuns runs_;
  std::vector<CaseSummary> summaries_;
};

TEST_F(CaseSummaryTest, CountsSuccessesAndTakesMeans) {
  const CaseSummary& wander = of({0, 0, 0, 1});
  EXPECT_EQ(wander.runs, 4u);
  EXPECT_EQ(wander.found, 3u);
  EXPECT_EQ(wander.median_s, 20);  // half of four searches are over at the second success
  EXPECT_TRUE(std::isinf(wander.quantile90_s));
  EXPECT_EQ(wander.driven_m, 1.5);
  EXPECT_EQ(wander.energy_wh, 3);
  EXPECT_TRUE(std::isnan(wander.overlap));
}

TEST_F(CaseSummaryTest, CensorsSearchesThatEndedEarlyAtTheLimit) {
  // Robots that broke down early: two of four searches succeed, both later than the ends of the others.
  set({0, 0, 0, 1}, {40, 60, -1, -1});
  for (auto& run : runs_) {
    if (run && run->case_index == plan_.indexOf({0, 0, 0, 1}) && !run->found_s) run->sim_time_s = 30;
  }
  const CaseSummary& wander = of({0, 0, 0, 1});
  EXPECT_EQ(wander.survival.back().searching, 0.5);
  EXPECT_EQ(wander.median_s, 60);
}

TEST_F(CaseSummaryTest, RelatesTimesToTheOracleFromTheSameStart) {
  EXPECT_EQ(of({0, 0, 0, 0}).competitive_ratio, 1);
  EXPECT_EQ(of({0, 0, 0, 1}).competitive_ratio, 4);  // of 2, 5, never, 3
  EXPECT_EQ(of({0, 0, 1, 1}).competitive_ratio, 4);  // of 4, 1, 5, 4
  // With noise relative to the oracle without: of 4, 10, never, never.
  EXPECT_TRUE(std::isinf(of({0, 1, 0, 1}).competitive_ratio.value()));
}

TEST_F(CaseSummaryTest, RelatesMediansToThoseOfTheSmallestTeam) {
  EXPECT_EQ(of({0, 0, 0, 1}).speed_up, 1);
  EXPECT_EQ(of({0, 0, 1, 1}).speed_up, 20.0 / 4);
  EXPECT_EQ(of({0, 0, 1, 0}).speed_up, 4.0 / 2);
}

TEST_F(CaseSummaryTest, ComparesStrategiesOnEqualStarts) {
  const auto comparisons = compareStrategies(plan_, runs_, false);
  ASSERT_EQ(comparisons.size(), 2u);  // each team in the ideal condition; the others lack the oracle
  EXPECT_EQ(comparisons[0].result.first_faster, 4u);
  EXPECT_EQ(comparisons[0].result.p, 0.125);
  EXPECT_EQ(comparisons[0].adjusted_p, 0.25);
  EXPECT_EQ(comparisons[1].result.first_faster, 3u);
  EXPECT_EQ(comparisons[1].result.ties, 1u);
  EXPECT_EQ(compareStrategies(plan_, runs_, true)[1].world, 0u);
}

TEST_F(CaseSummaryTest, RelatesConditionsToTheFirst) {
  const auto robustness = computeRobustness(plan_, runs_);
  ASSERT_EQ(robustness.size(), 1u);
  EXPECT_EQ(robustness[0].found_at_first, 3u);
  EXPECT_EQ(robustness[0].found, 2u);
  EXPECT_EQ(robustness[0].median_ratio, 2);  // of 2, 2, never; the start without success in the first does not count
  EXPECT_EQ(robustness[0].result.first_faster, 3u);
  EXPECT_DOUBLE_EQ(robustness[0].result.p, 0.25);
  EXPECT_DOUBLE_EQ(robustness[0].adjusted_p, 0.25) << "of a single comparison";
}

TEST_F(CaseSummaryTest, LeavesOutCasesWithoutRuns) {
  EXPECT_EQ(summarise(plan_, runs_).size(), 5u);
  EXPECT_TRUE(summarise(plan_, SearchRuns(plan_.runCount())).empty());
}

}  // namespace
}  // namespace robosim
