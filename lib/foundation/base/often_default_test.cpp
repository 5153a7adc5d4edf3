#include "base/often_default.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(OftenDefault, IsAsLargeAsAPointer) { EXPECT_EQ(sizeof(OftenDefault<std::string>), sizeof(void*)); }

TEST(OftenDefault, ReadsAsItsValue) {
  OftenDefault<std::string> text;
  EXPECT_TRUE(text.empty());
  EXPECT_EQ(text, "");
  text = "one";
  EXPECT_EQ(text, "one");
  EXPECT_EQ(text->size(), 3U);
  const std::string& same = text;
  EXPECT_EQ(same, "one");
  text = {};
  EXPECT_EQ(text, OftenDefault<std::string>());
}

TEST(OftenDefault, EqualsAnotherThatHasBeenSetToTheDefault) {
  OftenDefault<std::vector<int>> one, other;
  one.edit().push_back(1);
  EXPECT_FALSE(one == other);
  EXPECT_EQ(one[0], 1);
  one.clear();
  EXPECT_EQ(one, other);
  for (const int number : one) ADD_FAILURE() << number;
}

TEST(OftenDefault, CopiesItsValue) {
  OftenDefault<std::string> text = std::string("one");
  const OftenDefault<std::string> copy = text;
  text.edit() += " more";
  EXPECT_EQ(text, "one more");
  EXPECT_EQ(copy, "one");
}

}  // namespace
}  // namespace robosim
