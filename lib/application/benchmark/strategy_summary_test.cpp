#include "benchmark/strategy_summary.h"

#include <gtest/gtest.h>

#include "benchmark/report_tables.h"

namespace robosim {
namespace {

/// Two worlds, strategies oracle, wander and market, one robot, two starts.
class StrategySummaryTest : public testing::Test {
 protected:
  StrategySummaryTest() {
    plan_.worlds = {"a", "b"};
    plan_.strategies = {"oracle", "wander", "market"};
    plan_.teams = {1};
    plan_.runs = 2;
    plan_.time_s = 100;
    runs_.resize(plan_.runCount());
    setTimes({0, 0, 0, 0}, {2, 4});
    setTimes({0, 0, 0, 1}, {4, 12});
    setTimes({1, 0, 0, 0}, {10, 20});
    setTimes({1, 0, 0, 1}, {50, -1});
  }
  /// @param times negative: not found
  void setTimes(const SearchPlan::Case& c, const std::vector<double>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      SearchRun run;
      run.case_index = plan_.indexOf(c);
      run.seed = 1 + i;
      if (times[i] >= 0) run.found_s = times[i];
      runs_[run.case_index * plan_.runs + i] = run;
    }
  }
  SearchPlan plan_;
  SearchRuns runs_;
};

TEST_F(StrategySummaryTest, IsOfTheRunsInAllWorldsTogether) {
  const auto summaries = summariseStrategies(plan_, runs_);
  ASSERT_EQ(summaries.size(), 2u) << "market has no finished run";
  EXPECT_EQ(summaries[0].strategy, 0u);
  EXPECT_EQ(summaries[0].found, 4u);
  EXPECT_EQ(summaries[0].competitive_ratio, 1);
  EXPECT_EQ(summaries[1].strategy, 1u);
  EXPECT_EQ(summaries[1].runs, 4u);
  EXPECT_EQ(summaries[1].found, 3u);
  EXPECT_EQ(summaries[1].median_s, 12) << "two of four searches are over";
  EXPECT_EQ(summaries[1].competitive_ratio, 4) << "median of 2, 3, 5 and never";
}

TEST_F(StrategySummaryTest, HasNoRatioWithoutTheOracle) {
  plan_.strategies.front() = "random_walk";
  EXPECT_FALSE(summariseStrategies(plan_, runs_).front().competitive_ratio);
}

TEST_F(StrategySummaryTest, IsATableWithTheBestBesideTheOracleInBold) {
  EXPECT_NE(overviewTable(plan_, runs_, 0)
                .find("<th scope=col>strategy<th scope=col>1<th scope=col>1<th scope=col>1<tbody>\n"
                      "<tr><th scope=row>oracle<td>100.0<td>4.0<td>1.00\n"
                      "<tr><th scope=row>wander<td><b>75.0</b><td><b>12.0</b><td><b>4.00</b>\n</table>"),
            std::string::npos)
      << overviewTable(plan_, runs_, 0);
}

}  // namespace
}  // namespace robosim
