#include "base/printable_text.h"

#include <sstream>

#include <gtest/gtest.h>

#include "base/printable_stream.h"

namespace robosim {
namespace {

TEST(PrintableText, KeepsOrdinaryTextOfAnyLanguage) {
  for (const char* text : {"", "Robo 1 \\ x1b", "Průzkumník", "机器人", "\U0001F916", "\u00a0 … ×"}) {
    EXPECT_EQ(printableText(text), text);
    EXPECT_EQ(printableLines(text), text);
    EXPECT_EQ(printableJson(text), text);
  }
}

TEST(PrintableText, EscapesC0ControlsAndDel) {
  EXPECT_EQ(printableText("a\x1b[2Jb"), "a\\x1b[2Jb");
  EXPECT_EQ(printableText("a\r\n\tb\x7f"), "a\\x0d\\x0a\\x09b\\x7f");
  EXPECT_EQ(printableText(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(PrintableText, EscapesC1ControlsAsBytesAndAsUtf8) {
  EXPECT_EQ(printableText("\x9b"
                          "2J"),
            "\\x9b2J");
  EXPECT_EQ(printableText("\u009b2J\u0080\u009f"), "\\x9b2J\\x80\\x9f");
}

TEST(PrintableText, EscapesInvalidUtf8) {
  EXPECT_EQ(printableText("Pr\xf9zk"), "Pr\\xf9zk");
  EXPECT_EQ(printableText("\xe2\x82"), "\\xe2\\x82") << "a sequence that is cut off";
  EXPECT_EQ(printableText("\xc0\xaf"), "\\xc0\\xaf") << "an overlong sequence";
}

TEST(PrintableText, EscapesLineSeparatorsAndBidirectionalControls) {
  EXPECT_EQ(printableText("a\u2028b\u2029c"), "a\\u2028b\\u2029c");
  EXPECT_EQ(printableText("\u202a\u202e\u2066\u2069\u200e\u200f\u061c"),
            "\\u202a\\u202e\\u2066\\u2069\\u200e\\u200f\\u061c");
}

TEST(PrintableText, IsIdempotent) {
  const std::string once = printableText("\x1b\x9b\u202e\n");
  EXPECT_EQ(printableText(once), once);
}

TEST(PrintableLines, KeepsLineFeedsAndTabsOnly) { EXPECT_EQ(printableLines("a\n\tb\r\x1b"), "a\n\tb\\x0d\\x1b"); }

TEST(PrintableJson, WritesControlsAsJsonEscapes) {
  EXPECT_EQ(printableJson("{\n\"name\": \"a\u009b\x7f\u202e\"}"), "{\n\"name\": \"a\\u009b\\u007f\\u202e\"}");
}

TEST(Shortened, KeepsBeginningAndEndAndCountsTheBytesBetween) {
  EXPECT_EQ(shortened("0123456789", 10), "0123456789");
  // Of 6 bytes, 4 are before the gap and 2 after it.
  EXPECT_EQ(shortened("0123456789", 6), "0123 … (4 bytes omitted) … 89");
}

TEST(Shortened, CutsBetweenCharacters) {
  // "é" has two bytes; a cut after 4 bytes would divide the second é of "aéé…".
  EXPECT_EQ(shortened("aéézzzzzéz", 6), "aé … (9 bytes omitted) … z");
}

TEST(Quotable, ShortensLongValues) {
  const std::string quoted = quotable(std::string(8'000'000, '\n'));
  EXPECT_LT(quoted.size(), 500u);
  EXPECT_EQ(quoted.find('\n'), std::string::npos);
}

TEST(PrintableStream, EscapesOutputAndRestoresTheStream) {
  std::ostringstream out;
  {
    const PrintableStream printable(out);
    out << "a\x1b[2J" << '\x1b' << "b\n" << 1.5 << '\n';
  }
  out << "\x1b";
  EXPECT_EQ(out.str(),
            "a\\x1b[2J\\x1b"
            "b\n1.5\n\x1b");
}

TEST(PrintableStream, AcceptsCharactersWrittenInParts) {
  std::ostringstream out;
  {
    const PrintableStream printable(out);
    for (const char byte : std::string("…机\U0001F916\u009b")) out << byte;
    out << "\xe2\x80";
  }
  EXPECT_EQ(out.str(), "…机\U0001F916\\x9b\\xe2\\x80");
}

}  // namespace
}  // namespace robosim
