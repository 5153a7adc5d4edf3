#include "base/utf8.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Utf8, AcceptsWellFormedSequences) {
  for (const char* text : {"", "Robo", "Průzkumník", "机器人", "\U0001F916", "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(isUtf8(text)) << text;
  }
  EXPECT_TRUE(isUtf8(std::string_view("a\0b", 3)));
}

TEST(Utf8, RejectsLatin1TruncatedAndOverlongSequencesSurrogatesAndInvalidCodePoints) {
  for (const char* text : {"Pr\xF9zkumn\xEDk", "\x80", "\xC3", "\xE2\x82", "\xF0\x9F\xA4", "\xC0\xAF", "\xE0\x80\xAF",
                           "\xF0\x80\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF"}) {
    EXPECT_FALSE(isUtf8(text)) << text;
  }
}

TEST(Utf8, FindsTheLongestPrefixAtACodePointBoundary) {
  EXPECT_EQ(utf8Prefix("Robo", 4), "Robo");
  EXPECT_EQ(utf8Prefix("Robo", 3), "Rob");
  EXPECT_EQ(utf8Prefix("机器人", 9), "机器人");
  for (const std::size_t bytes : {6u, 7u, 8u}) EXPECT_EQ(utf8Prefix("机器人", bytes), "机器") << bytes;
  EXPECT_EQ(utf8Prefix("\U0001F916", 3), "");
}

}  // namespace
}  // namespace robosim
