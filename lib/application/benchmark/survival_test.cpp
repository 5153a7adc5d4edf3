#include "benchmark/survival.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// Weeks in remission of 21 patients treated with 6-MP (Freireich et al., 1963), which textbooks on survival use.
std::vector<SearchTime> remissions() {
  std::vector<SearchTime> times;
  for (const double weeks : {6, 6, 6, 7, 10, 13, 16, 22, 23}) times.push_back({weeks, true});
  for (const double weeks : {6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35}) times.push_back({weeks, false});
  return times;
}

TEST(Survival, IsThatOfThePublishedExample) {
  const auto curve = survivalCurve(remissions());
  const double weeks[] = {6, 7, 10, 13, 16, 22, 23};
  const double survival[] = {0.857, 0.807, 0.753, 0.690, 0.627, 0.538, 0.448};
  const double low[] = {0.620, 0.563, 0.503, 0.432, 0.368, 0.268, 0.188};
  const double high[] = {0.952, 0.923, 0.889, 0.849, 0.805, 0.747, 0.680};
  const std::size_t at_risk[] = {21, 17, 15, 12, 11, 7, 6};
  ASSERT_EQ(curve.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(curve[i].time_s, weeks[i]);
    EXPECT_NEAR(curve[i].searching, survival[i], 0.0005);
    EXPECT_NEAR(curve[i].low, low[i], 0.0006);
    EXPECT_NEAR(curve[i].high, high[i], 0.0006);
    EXPECT_EQ(curve[i].at_risk, at_risk[i]);
  }
  EXPECT_EQ(medianTime(remissions()), 23);
}

TEST(Survival, IsTheShareStillSearchingWithoutCensoring) {
  const std::vector<SearchTime> times{{4, true}, {1, true}, {3, true}, {2, true}};
  const auto curve = survivalCurve(times);
  ASSERT_EQ(curve.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(curve[i].searching, 0.75 - 0.25 * static_cast<double>(i), 1e-15);
  EXPECT_EQ(curve.back().low, 0);
  EXPECT_EQ(medianTime(times), 2);
}

TEST(Survival, HasNoMedianWhenMostSearchesAreCensored) {
  const std::vector<SearchTime> times{{1, true}, {9, false}, {9, false}};
  EXPECT_TRUE(std::isinf(medianTime(times)));
  EXPECT_TRUE(std::isinf(medianInterval(times, 1).high));
  EXPECT_TRUE(survivalCurve(std::vector<SearchTime>{{9, false}}).empty());
}

TEST(Survival, MedianOfHalfFoundIsTheTimeAtWhichHalfWereFound) {
  const std::vector<SearchTime> times{{3, true}, {5, true}, {9, false}, {9, false}};
  EXPECT_EQ(medianTime(times), 5);
}

TEST(Survival, IntervalOfTheMedianHasTheOrderStatisticsOfTheBinomialDistribution) {
  // For 99 different times the 95 % interval lies between the 40th and the 60th, give or take the resampling.
  std::vector<SearchTime> times;
  for (int i = 1; i <= 99; ++i) times.push_back({static_cast<double>(i), true});
  const Interval interval = medianInterval(times, 7);
  EXPECT_NEAR(interval.low, 40, 2);
  EXPECT_NEAR(interval.high, 60, 2);
  EXPECT_EQ(medianInterval(times, 7).low, interval.low);
  EXPECT_EQ(medianInterval(std::vector<SearchTime>{{5, true}}, 1).low, 5);
}

TEST(Survival, IntervalOfAShareIsWilsons) {
  EXPECT_NEAR(shareInterval(8, 10).low, 0.490, 0.0005);
  EXPECT_NEAR(shareInterval(8, 10).high, 0.943, 0.0005);
  EXPECT_EQ(shareInterval(0, 10).low, 0);
  EXPECT_NEAR(shareInterval(0, 10).high, 0.278, 0.0005);
  EXPECT_EQ(shareInterval(10, 10).high, 1);
}

}  // namespace
}  // namespace robosim
