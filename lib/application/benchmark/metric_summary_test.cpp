#include "benchmark/metric_summary.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Observed {
  double value;
  double end_s = 100;
  std::string ended_by = "time_limit";
};

MetricSummary summaryOf(const std::string& name, const std::vector<Observed>& observed) {
  std::vector<SearchRun> runs;
  for (const auto& one : observed) {
    SearchRun& run = runs.emplace_back();
    run.metrics = {{name, one.value}};
    run.sim_time_s = one.end_s;
    run.ended_by = one.ended_by;
  }
  std::vector<const SearchRun*> pointers;
  for (const auto& run : runs) pointers.push_back(&run);
  return summariseMetrics(pointers, 100, 1).front();
}

TEST(MetricSummary, HasMeanAndQuantilesOfTheValues) {
  std::vector<Observed> ten;
  for (int i = 1; i <= 10; ++i) ten.push_back({10.0 * i});
  const MetricSummary summary = summaryOf("covered_percent", ten);
  EXPECT_EQ(summary.name, "covered_percent");
  EXPECT_EQ(summary.values, 10u);
  EXPECT_DOUBLE_EQ(summary.mean, 55);
  EXPECT_DOUBLE_EQ(summary.deviation, std::sqrt(8250.0 / 9));  // squares of 5, 15 … 45, twice
  EXPECT_EQ(summary.quantile10, 10);
  EXPECT_EQ(summary.median, 50);
  EXPECT_EQ(summary.quantile90, 90);
  EXPECT_LE(summary.median_interval.low, 50);
  EXPECT_GE(summary.median_interval.high, 50);
}

TEST(MetricSummary, CountsATimeThatARunHasNotAsLaterThanTheRun) {
  // Six of twenty events in 100 s: the mean of the six would describe the fast runs only.
  std::vector<Observed> runs(14, Observed{kNone});
  for (const double time_s : {5.0, 8.0, 11.0, 12.0, 14.0, 18.0}) runs.push_back({time_s});
  const MetricSummary summary = summaryOf("half_covered_s", runs);
  EXPECT_EQ(summary.values, 6u);
  EXPECT_EQ(summary.runs, 20u);
  EXPECT_TRUE(std::isnan(summary.mean));
  EXPECT_TRUE(std::isnan(summary.deviation));
  EXPECT_EQ(summary.quantile10, 8) << "the second of twenty";
  EXPECT_EQ(summary.median, std::numeric_limits<double>::infinity());
  EXPECT_EQ(summary.quantile90, std::numeric_limits<double>::infinity());
}

TEST(MetricSummary, ObservesARunThatAnObserverEndsUntilThenAndOneOfHaltedRobotsToTheLimit) {
  // Ended at 10 s, it is not at risk later: of the other three, two have the event by 30 s, so that 2/3 do.
  const MetricSummary ended = summaryOf("found_s", {{kNone, 10, "observer"}, {20}, {30}, {kNone}});
  EXPECT_EQ(ended.median, 30);
  const MetricSummary halted = summaryOf("found_s", {{kNone, 10, "all_halted"}, {20}, {30}, {kNone}, {kNone}});
  EXPECT_EQ(halted.median, std::numeric_limits<double>::infinity()) << "3 of 5 have none";
}

TEST(MetricSummary, IsOfTheRunsThatHaveAValueUnlessItIsATime) {
  const MetricSummary summary = summaryOf("gap_m", {{-2}, {kNone}, {4}, {6}});
  EXPECT_EQ(summary.values, 3u);
  EXPECT_DOUBLE_EQ(summary.mean, 8.0 / 3);
  EXPECT_EQ(summary.median, 4);
  EXPECT_FALSE(isTime("messages_per_s"));
  EXPECT_TRUE(std::isnan(summaryOf("gap_m", {{kNone}, {kNone}}).median));
  EXPECT_TRUE(std::isnan(summaryOf("gap_m", {{3}}).deviation));
}

}  // namespace
}  // namespace robosim
