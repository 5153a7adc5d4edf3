#include "ros/cdr.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "ros/messages.h"

namespace robosim::ros {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <Message M>
Bytes encoded(const M& message) {
  Bytes bytes;
  encode(message, bytes);
  return bytes;
}

/// All kinds of field.
struct Sample {
  bool flag = false;
  double number = 0;
  std::string text;
  std::vector<std::int16_t> numbers;
  std::vector<std::string> texts;
  std::array<float, 2> pair{};
  std::vector<Time> times;
  std::uint64_t last = 0;
  static constexpr const char* kType = "test_msgs/msg/Sample";
  static void describe(auto& self, auto&& visit) {
    visit("flag", self.flag);
    visit("number", self.number);
    visit("text", self.text);
    visit("numbers", self.numbers);
    visit("texts", self.texts);
    visit("pair", self.pair);
    visit("times", self.times);
    visit("last", self.last);
  }
  bool operator==(const Sample&) const = default;
};

const Sample kSample{true, -2.5, "añb", {1, -1, 300}, {"", "x"}, {0.5f, -0.25f}, {{-7, 8}, {9, 10}}, 1ull << 40};

std::string errorOf(const Bytes& bytes) {
  try {
    decode<Sample>(bytes);
  } catch (const CdrError& error) {
    return error.what();
  }
  return "";
}

TEST(Cdr, EncodesAStringWithItsLengthAndNul) {
  EXPECT_EQ(encoded(String{"hi"}), (Bytes{0, 1, 0, 0, 3, 0, 0, 0, 'h', 'i', 0}));
  EXPECT_EQ(encoded(String{""}), (Bytes{0, 1, 0, 0, 1, 0, 0, 0, 0}));
}

TEST(Cdr, AlignsNumbersToTheirSizeAfterTheHeader) {
  // Header: stamp (8 bytes), string "a" (4 + 2), 2 bytes of padding, then the doubles at multiples of 8.
  const Temperature message{{{1, 2}, "a"}, 1.0, 0.0};
  EXPECT_EQ(encoded(message), (Bytes{0, 1, 0, 0, 1, 0, 0, 0, 2,    0,    0, 0, 2, 0, 0, 0, 'a', 0,
                                     0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 0, 0, 0, 0, 0, 0, 0,   0}));
}

TEST(Cdr, DoesNotAlignTheElementsOfAnEmptySequence) {
  CameraInfo info;
  info.distortion_model = "abc";  // ends at a multiple of 8 + 4
  Bytes bytes = encoded(info);
  // header 4 + stamp 8 + frame_id 5 + padding 3 + height, width 8 + string 4 + 4, then d's count, then k at 40.
  EXPECT_EQ(bytes.size(), 4u + 40 + 9 * 8 + 9 * 8 + 12 * 8 + 8 + 16 + 1);
  EXPECT_EQ(decode<CameraInfo>(bytes), info);
}

TEST(Cdr, AppendsToOtherBytesWithItsOwnAlignment) {
  Bytes bytes{9, 9, 9};
  encode(kSample, bytes);
  EXPECT_EQ(Bytes(bytes.begin() + 3, bytes.end()), encoded(kSample));
}

TEST(Cdr, DecodesWhatItEncodes) { EXPECT_EQ(decode<Sample>(encoded(kSample)), kSample); }

TEST(Cdr, KeepsInfinitiesAndNaN) {
  LaserScan scan;
  scan.ranges = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(), std::nanf("")};
  const LaserScan read = decode<LaserScan>(encoded(scan));
  EXPECT_EQ(read.ranges[0], scan.ranges[0]);
  EXPECT_EQ(read.ranges[1], scan.ranges[1]);
  EXPECT_TRUE(std::isnan(read.ranges[2]));
}

TEST(Cdr, DecodesBigEndianMessages) {
  const Bytes bytes{0, 0, 0, 0, 0xff, 0xff, 0xff, 0xfe, 0, 0, 1, 2};
  EXPECT_EQ(decode<Time>(bytes), (Time{-2, 258}));
}

TEST(Cdr, IgnoresBytesAfterTheMessage) {
  Bytes bytes = encoded(kSample);
  bytes.push_back(7);
  EXPECT_EQ(decode<Sample>(bytes), kSample);
}

TEST(Cdr, RefusesEveryMessageThatIsCutOff) {
  const Bytes whole = encoded(kSample);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(errorOf(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), "") << size;
  }
}

TEST(Cdr, SaysWhatCannotBe) {
  EXPECT_EQ(errorOf({0, 7, 0, 0}), "the message does not begin with a header of CDR (XCDR1)");
  EXPECT_EQ(errorOf({0, 1, 0, 0, 2}), "the message has a bool of 2 at byte 5, which cannot be: it has 5 bytes");
  try {
    decode<LaserScan>(Bytes{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 9, 0, 0, 0});
    FAIL() << "no error";
  } catch (const CdrError& error) {
    EXPECT_STREQ(error.what(), "the message has a string of 2313 bytes at byte 16, which cannot be: it has 17 bytes");
  }
}

TEST(Cdr, RefusesASequenceThatIsLargerThanTheMessageWithoutAllocatingIt) {
  // A TFMessage of 2³² - 1 transforms.
  EXPECT_THROW(decode<TFMessage>(Bytes{0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0}), CdrError);
}

}  // namespace
}  // namespace robosim::ros
