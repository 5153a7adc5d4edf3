#include "base/error_list.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(ErrorList, ThrowsAllErrorsAtOnceOnePerLine) {
  ErrorList errors;
  EXPECT_NO_THROW(errors.throwIfAny());
  errors.add("a.xml", 3, "first");
  errors.add(ConfigError(std::vector<std::string>{"b.xml:1: second", "b.xml:2: third"}));
  try {
    errors.throwIfAny();
    FAIL() << "nothing was thrown";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "a.xml:3: first\nb.xml:1: second\nb.xml:2: third");
    EXPECT_EQ(error.errors().size(), 3u);
  }
}

TEST(ErrorList, CountsErrorsBeyondTheMaximum) {
  ErrorList errors;
  for (int i = 1; i <= 1001; ++i) errors.add("a.xml", i, "wrong");
  ASSERT_EQ(errors.errors().size(), 1001u);
  EXPECT_EQ(errors.count(), 1001u);
  EXPECT_EQ(errors.errors()[999], "a.xml:1000: wrong");
  EXPECT_EQ(errors.errors()[1000], "and 1 more error");
  for (int i = 0; i < 41; ++i) errors.add("a.xml", i, "wrong");
  EXPECT_EQ(errors.errors().size(), 1001u);
  EXPECT_EQ(errors.count(), 1042u);
  EXPECT_EQ(errors.errors().back(), "and 42 more errors");
}

TEST(Listed, ListsAtMostTwentyWords) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a"}), "a");
  EXPECT_EQ(listed({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(listed(std::vector<std::string>(22, "a")),
            "a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a and 2 more");
}

}  // namespace
}  // namespace robosim
