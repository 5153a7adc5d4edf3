#include "base/jpeg_file.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/testing/sample_jpeg.h"

namespace robosim {
namespace {

/// 16 × 8 pixels: the left half black, the right half white, along the edge of two blocks of 8 × 8 pixels.
std::string halves(int channels, bool progressive = false) {
  std::vector<std::uint8_t> values;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 16; ++column) values.insert(values.end(), channels, column < 8 ? 0 : 255);
  }
  return jpegBytes(16, 8, channels, values, progressive);
}

TEST(JpegFile, DecodesGrayAndColour) {
  for (const int channels : {1, 3}) {
    for (const bool progressive : {false, true}) {
      std::string fault = "none";
      const JpegPicture picture = decodeJpeg(halves(channels, progressive), fault);
      EXPECT_EQ(fault, "");
      EXPECT_EQ(picture.columns, 16u);
      EXPECT_EQ(picture.rows, 8u);
      ASSERT_EQ(picture.channels, static_cast<std::uint32_t>(channels));
      ASSERT_EQ(picture.values.size(), 16u * 8 * static_cast<std::size_t>(channels));
      EXPECT_LE(picture.values.front(), 2);
      EXPECT_GE(picture.values.back(), 253);
    }
  }
}

TEST(JpegFile, HasTheSizeInItsHeader) {
  const std::string file = halves(1);
  EXPECT_EQ(jpegSize(file).columns, 16u);
  EXPECT_EQ(jpegSize(file).rows, 8u);
  EXPECT_EQ(jpegSize(file.substr(0, 10)).columns, 0u);
}

TEST(JpegFile, ReportsOtherFilesInPlaceOfEndingTheProcess) {
  EXPECT_EQ(jpegFault("GIF89a"), "Not a JPEG file: starts with 0x47 0x49");
  EXPECT_NE(jpegFault(""), "");
  EXPECT_NE(jpegFault("\xff\xd8"), "");
}

TEST(JpegFile, ReportsEveryTruncation) {
  const std::string file = halves(3);
  EXPECT_EQ(jpegFault(file), "");
  // The last two bytes are the end mark.
  for (std::size_t size = 0; size < file.size() - 2; ++size) EXPECT_NE(jpegFault(file.substr(0, size)), "") << size;
}

TEST(JpegFile, ReportsDamagedPixelsWhereLibjpegOnlyWarns) {
  std::string file = halves(3);
  file.insert(file.size() - 2, 4, '\0');
  EXPECT_EQ(jpegFault(file), "") << "superfluous bytes";
  file = halves(3, true);
  const auto scan = file.find("\xff\xda");
  ASSERT_NE(scan, std::string::npos);
  file.erase(scan + 12, 4);
  EXPECT_NE(jpegFault(file), "");
}

TEST(JpegFile, RejectsPicturesThatNeedTooMuchMemory) {
  std::string file = halves(3, true);
  const auto frame = file.find("\xff\xc2");  // progressive: all coefficients are kept in memory
  ASSERT_NE(frame, std::string::npos);
  std::fill(file.begin() + static_cast<std::ptrdiff_t>(frame) + 5,
            file.begin() + static_cast<std::ptrdiff_t>(frame) + 9,
            '\xfe');  // the height and the width
  EXPECT_NE(jpegFault(file), "");
  std::string fault;
  EXPECT_TRUE(decodeJpeg(file, fault).values.empty());
  EXPECT_NE(fault, "");
}

TEST(JpegFile, SurvivesArbitraryDamage) {
  const std::string file = halves(3);
  std::size_t faults = 0;
  for (std::size_t at = 0; at < file.size(); ++at) {
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string damaged = file;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      faults += jpegFault(damaged).empty() ? 0 : 1;
    }
  }
  EXPECT_GT(faults, file.size() / 2);
}

}  // namespace
}  // namespace robosim
