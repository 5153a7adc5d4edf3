#include "base/shared_value.h"

#include <string>

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Text = SharedValue<std::string>;

TEST(SharedValue, IsSharedByCopiesUntilOneIsChanged) {
  Text text = std::string("one");
  Text copy = text;
  EXPECT_EQ(&*copy, &*text);
  copy.edit() += " more";
  EXPECT_EQ(*copy, "one more");
  EXPECT_EQ(*text, "one");
  const std::string* const own = &*copy;
  copy.edit() += " again";
  EXPECT_EQ(&*copy, own) << "not shared";
}

TEST(SharedValue, IsTheDefaultUntilItIsSet) {
  Text text;
  EXPECT_TRUE(text->empty());
  EXPECT_EQ(text, Text(std::string()));
  text.edit() = "set";
  EXPECT_EQ(*text, "set");
  EXPECT_EQ(*Text(), "");
}

}  // namespace
}  // namespace robosim
