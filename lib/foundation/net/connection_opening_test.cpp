#include "net/connection_opening.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Verdict = ConnectionOpening::Verdict;

constexpr std::uint8_t kData = 0, kHeaders = 1, kReset = 3, kSettings = 4, kPing = 6, kGoaway = 7, kWindowUpdate = 8,
                       kContinuation = 9;
constexpr std::uint8_t kEndHeaders = 4, kPadded = 8, kPriority = 32;

std::string frame(std::uint8_t type, std::uint8_t flags, std::uint32_t stream, const std::string& payload) {
  std::string bytes;
  for (const int shift : {16, 8, 0}) bytes += static_cast<char>(payload.size() >> shift);
  bytes += static_cast<char>(type);
  bytes += static_cast<char>(flags);
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(stream >> shift);
  return bytes + payload;
}

/// A header field as a literal without indexing.
std::string field(const std::string& name, const std::string& value) {
  return std::string(1, '\0') + static_cast<char>(name.size()) + name + static_cast<char>(value.size()) + value;
}

const std::string kOpening = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + frame(kSettings, 0, 0, "");
const std::string kCall = field(":method", "POST") + field(":path", "/a.B/C") + field("authorization", "Bearer secret");
const std::string kMessage{0, 0, 0, 0, 0};  ///< empty, with its prefix of five bytes

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

Verdict verdictOf(const std::string& bytes) { return ConnectionOpening().add(bytes); }

TEST(ConnectionOpening, FindsACallWithItsPathTokenAndMessage) {
  ConnectionOpening opening;
  EXPECT_EQ(opening.add(kOpening + frame(kWindowUpdate, 0, 0, {0, 0, 1, 0})), Verdict::valid);
  EXPECT_TRUE(opening.calls().empty());
  EXPECT_EQ(opening.add(frame(kHeaders, kEndHeaders, 1, kCall)), Verdict::valid);
  ASSERT_EQ(opening.calls().size(), 1u);
  EXPECT_EQ(opening.calls()[0].path, "/a.B/C");
  EXPECT_EQ(opening.calls()[0].token, "Bearer secret");
  EXPECT_FALSE(opening.calls()[0].hasMessage());
  EXPECT_EQ(opening.add(frame(kData, 0, 1, kMessage)), Verdict::valid);
  EXPECT_TRUE(opening.calls()[0].hasMessage());
}

TEST(ConnectionOpening, DependsOnTheBytesAndNotOnTheirPackets) {
  const std::string bytes = kOpening + frame(kHeaders, kEndHeaders, 1, kCall) + frame(kData, 0, 1, kMessage);
  ConnectionOpening opening;
  for (const char byte : bytes) ASSERT_EQ(opening.add(std::string(1, byte)), Verdict::valid);
  ASSERT_EQ(opening.calls().size(), 1u);
  EXPECT_TRUE(opening.calls()[0].hasMessage());
  EXPECT_EQ(opening.bytes(), bytes);
}

TEST(ConnectionOpening, FindsTheBeginningOfALongMessage) {
  ConnectionOpening opening;
  const std::string message = frame(kData, 0, 1, std::string(16'384, '\0'));
  EXPECT_EQ(opening.add(kOpening + frame(kHeaders, kEndHeaders, 1, kCall) + message.substr(0, 9 + 4)), Verdict::valid);
  EXPECT_FALSE(opening.calls()[0].hasMessage());
  opening.add("\1");
  EXPECT_TRUE(opening.calls()[0].hasMessage());
}

TEST(ConnectionOpening, JoinsAHeaderBlockOfSeveralFramesWithPaddingAndPriority) {
  ConnectionOpening opening;
  const std::string padded = '\3' + std::string(5, '\0') + kCall.substr(0, 20) + std::string(3, '\0');
  EXPECT_EQ(opening.add(kOpening + frame(kHeaders, kPadded | kPriority, 1, padded)), Verdict::valid);
  EXPECT_TRUE(opening.calls().empty());
  EXPECT_EQ(opening.add(frame(kContinuation, kEndHeaders, 1, kCall.substr(20))), Verdict::valid);
  EXPECT_EQ(opening.calls().at(0).path, "/a.B/C");
}

TEST(ConnectionOpening, ForgetsACallThatIsReset) {
  ConnectionOpening opening;
  opening.add(kOpening + frame(kHeaders, kEndHeaders, 1, kCall) + frame(kReset, 0, 1, {0, 0, 0, 8}));
  EXPECT_TRUE(opening.calls().empty());
}

TEST(ConnectionOpening, ExceedsItsLimitsInEveryKindOfFlood) {
  const std::string call = frame(kHeaders, kEndHeaders, 1, kCall);
  const std::string begun = frame(kHeaders, 0, 1, kCall);
  std::string headers, resets;
  for (std::uint32_t stream = 1; stream < 2 * 100; stream += 2) {
    headers += frame(kHeaders, kEndHeaders, stream, "");
    resets += frame(kHeaders, kEndHeaders, stream, "") + frame(kReset, 0, stream, {0, 0, 0, 8});
  }
  for (const std::string& flood :
       {repeated(frame(kPing, 0, 0, std::string(8, '\0')), 100), repeated(frame(kSettings, 0, 0, ""), 100),
        call + repeated(frame(kData, 0, 1, ""), 100), begun + repeated(frame(kContinuation, 0, 1, ""), 100), headers,
        resets, repeated(frame(kGoaway, 0, 0, std::string(8, '\0')), 100),
        repeated(frame(kWindowUpdate, 0, 0, {0, 0, 0, 1}), 100)}) {
    EXPECT_EQ(verdictOf(kOpening + flood), Verdict::excess);
  }
  EXPECT_EQ(verdictOf(kOpening + repeated(frame(200, 0, 0, std::string(8192, 'x')), 3)), Verdict::excess) << "bytes";
}

TEST(ConnectionOpening, RejectsWhatIsNotHttp2) {
  EXPECT_EQ(verdictOf("GET / HTTP/1.1\r\n"), Verdict::no_http2);
  EXPECT_EQ(verdictOf("\x16\x03\x01"), Verdict::no_http2);
  EXPECT_EQ(verdictOf("PRI"), Verdict::valid) << "may become HTTP/2";
  const std::string preface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
  for (const std::string& invalid :
       {preface + frame(kPing, 0, 0, std::string(8, '\0')), kOpening + frame(kData, 0, 1, ""),
        kOpening + frame(kHeaders, kEndHeaders, 2, kCall), kOpening + frame(kHeaders, kEndHeaders, 1, "\xff"),
        kOpening + frame(kHeaders, kEndHeaders, 3, kCall) + frame(kHeaders, kEndHeaders, 1, kCall),
        kOpening + frame(kHeaders, kPadded, 1, "\x7f"), kOpening + frame(kContinuation, 0, 1, ""),
        kOpening + frame(kHeaders, 0, 1, kCall) + frame(kPing, 0, 0, std::string(8, '\0')),
        kOpening + frame(kReset, 0, 1, {0, 0, 0, 8}), kOpening + std::string("\0\x40\1\0\0\0\0\0\0", 9)}) {
    EXPECT_EQ(verdictOf(invalid), Verdict::invalid);
  }
}

}  // namespace
}  // namespace robosim
