#include "benchmark/paired_comparison.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(PairedComparison, CountsWhoWasFirst) {
  const std::vector<SearchTime> first{{1, true}, {2, true}, {9, false}, {9, false}, {3, true}};
  const std::vector<SearchTime> second{{2, true}, {9, false}, {8, true}, {9, false}, {3, true}};
  const PairedComparison result = comparePaired(first, second);
  EXPECT_EQ(result.first_faster, 2u);  // the second was slower, or had no success
  EXPECT_EQ(result.second_faster, 1u);
  EXPECT_EQ(result.ties, 2u);
  EXPECT_EQ(result.p, 1);
}

TEST(PairedComparison, ComputesTheBinomialProbability) {
  std::vector<SearchTime> first(10, {1, true}), second(10, {2, true});
  EXPECT_NEAR(comparePaired(first, second).p, 2.0 / 1024, 1e-15);
  first[3].time_s = first[7].time_s = 3;  // 8 of 10: 2 · (1 + 10 + 45) / 1024
  EXPECT_NEAR(comparePaired(first, second).p, 112.0 / 1024, 1e-14);
  EXPECT_NEAR(comparePaired(second, first).p, 112.0 / 1024, 1e-14);
  EXPECT_EQ(comparePaired({}, {}).p, 1);
}

TEST(PairedComparison, AdjustsForTheNumberOfTests) {
  const std::vector<double> p{0.01, 0.04, 0.03, 0.9};
  const auto adjusted = holmAdjusted(p);  // 4 · 0.01, then 3 · 0.03, then 2 · 0.04, which is not smaller than before
  ASSERT_EQ(adjusted.size(), 4u);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.04);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.09);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.09);
  EXPECT_DOUBLE_EQ(adjusted[3], 0.9);
}

}  // namespace
}  // namespace robosim
