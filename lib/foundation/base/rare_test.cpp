#include "base/rare.h"

#include <string>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Rare, IsAsLargeAsAPointer) { EXPECT_EQ(sizeof(Rare<std::string>), sizeof(void*)); }

TEST(Rare, HasNoValueUntilItIsGivenOne) {
  Rare<std::string> rare;
  EXPECT_FALSE(rare);
  EXPECT_EQ(rare.value_or("none"), "none");
  EXPECT_EQ(std::optional<std::string>(rare), std::nullopt);
  rare = std::string("one");
  EXPECT_TRUE(rare.has_value());
  EXPECT_EQ(*rare, "one");
  EXPECT_EQ(rare->size(), 3U);
  EXPECT_EQ(std::optional<std::string>(rare), "one");
  rare.reset();
  EXPECT_FALSE(rare);
  EXPECT_EQ(rare.emplace(), "");
}

TEST(Rare, CopiesItsValue) {
  Rare<std::string> rare = std::string("one");
  const Rare<std::string> copy = rare;
  *rare = "other";
  EXPECT_EQ(*copy, "one");
  rare = copy;
  EXPECT_EQ(rare, copy);
  rare = *&rare;  // also of itself
  EXPECT_EQ(*rare, "one");
}

TEST(Rare, ComparesValues) {
  const Rare<int> none, one = 1, other = 2;
  EXPECT_EQ(none, Rare<int>());
  EXPECT_EQ(one, Rare<int>(std::optional(1)));
  EXPECT_EQ(one, 1);
  EXPECT_FALSE(one == other);
  EXPECT_FALSE(one == none);
  EXPECT_FALSE(none == 0);
}

}  // namespace
}  // namespace robosim
