#include "environment/repeated_values.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(RepeatedValues, KeepsEqualValuesOnce) {
  const RepeatedValues<double> repeated({1, 2, 2, 1, 3});
  ASSERT_EQ(repeated.size(), 5U);
  EXPECT_EQ(repeated[0], 1);
  EXPECT_EQ(repeated[1], 2);
  EXPECT_EQ(repeated[2], 2);
  EXPECT_EQ(repeated[3], 1);
  EXPECT_EQ(repeated[4], 3);
  EXPECT_EQ(repeated.values(), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(&repeated[0], &repeated[3]);
}

TEST(RepeatedValues, IsAsLargeForEqualValues) {
  const RepeatedValues<double> repeated({4, 4, 4});
  ASSERT_EQ(repeated.size(), 3U);
  EXPECT_FALSE(repeated.empty());
  EXPECT_EQ(&repeated[2], &repeated[0]);
  EXPECT_EQ(repeated[2], 4);
}

TEST(RepeatedValues, HasAllOfManyValues) {
  std::vector<int> all;
  for (int i = 0; i < 1000; ++i) all.push_back(i % 300);
  const RepeatedValues<int> repeated(all);
  for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(repeated[i], all[i]);
}

TEST(RepeatedValues, MayBeEmpty) {
  EXPECT_TRUE(RepeatedValues<int>().empty());
  EXPECT_TRUE(RepeatedValues<int>(std::vector<int>()).empty());
}

}  // namespace
}  // namespace robosim
