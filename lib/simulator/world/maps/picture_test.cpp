#include "world/maps/picture.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "base/random.h"
#include "base/testing/sample_jpeg.h"
#include "world/maps/testing/map_samples.h"

namespace robosim {
namespace {

std::string cellsOf(const std::string& bytes, const PixelInterpretation& meaning = {},
                    Picture::Alpha alpha = Picture::Alpha::counts) {
  return drawn(gridOf(readPicture(bytes, "a", alpha), meaning));
}

TEST(Picture, IsEqualInEveryPortableFormat) {
  const std::string cells = "#..\n.?#\n";
  for (const std::string bytes :
       {"P2 3 2 255 0 255 254 255 128 10", "P2\n# made by hand\n3 2 # wide, high\n15\n0 15 15\n15 8 1\n",
        "P3 3 2 255  0 0 0  255 255 255  254 254 254  255 255 255  128 128 128  10 10 10",
        "P5 3 2 255\n\x01\xff\xff\xff\x80\x0a",
        "P6\n3 2\n255\n\x01\x01\x01\xff\xff\xff\xff\xff\xff\xff\xff\xff\x80\x80\x80\x0a\x0a\x0a"}) {
    EXPECT_EQ(cellsOf(bytes), cells) << bytes;
  }
  const std::string of_two_bytes("P5 3 2 1000\n\x00\x00\x03\xe8\x03\xe8\x03\xe8\x02\x00\x00\x0a", 24);
  EXPECT_EQ(cellsOf(of_two_bytes), cells);
}

TEST(Picture, ReadsSetBitsAsBlack) {
  EXPECT_EQ(cellsOf("P1 3 2\n100 0 1\n1"), "#..\n.##\n");
  EXPECT_EQ(cellsOf("P4 3 2\n\x80\x60"), "#..\n.##\n");
}

TEST(Picture, AveragesTheChannelsOfPng) {
  cv::Mat gray(1, 3, CV_8U);
  gray.at<std::uint8_t>(0, 0) = 0;
  gray.at<std::uint8_t>(0, 1) = 205;
  gray.at<std::uint8_t>(0, 2) = 254;
  EXPECT_EQ(cellsOf(pngBytes(gray)), "#?.\n");
  cv::Mat deep;
  gray.convertTo(deep, CV_16U, 257);
  EXPECT_EQ(cellsOf(pngBytes(deep)), "#?.\n");
  // (10 + 20 + 30) / 3 = 20 is dark; (255 + 255 + 0) / 3 = 170 is neither.
  cv::Mat color(1, 2, CV_8UC3);
  color.at<cv::Vec3b>(0, 0) = {10, 20, 30};
  color.at<cv::Vec3b>(0, 1) = {255, 255, 0};
  EXPECT_EQ(cellsOf(pngBytes(color)), "#?\n");
}

TEST(Picture, IncludesAlphaOnlyOnRequest) {
  cv::Mat picture(1, 2, CV_8UC4);
  picture.at<cv::Vec4b>(0, 0) = {60, 60, 60, 255};  // 60, or with alpha 108.75: p = 0.765, or 0.574
  picture.at<cv::Vec4b>(0, 1) = {255, 255, 255, 255};
  EXPECT_EQ(cellsOf(pngBytes(picture), {}, Picture::Alpha::counts), "?.\n");
  EXPECT_EQ(cellsOf(pngBytes(picture), {}, Picture::Alpha::is_left_out), "#.\n");
}

TEST(Picture, TakesPixelsThatAreNotOpaqueForUnknownOnRequest) {
  cv::Mat picture(1, 3, CV_8UC4);
  picture.at<cv::Vec4b>(0, 0) = {0, 0, 0, 255};
  picture.at<cv::Vec4b>(0, 1) = {0, 0, 0, 254};
  picture.at<cv::Vec4b>(0, 2) = {255, 255, 255, 0};
  EXPECT_EQ(cellsOf(pngBytes(picture), {}, Picture::Alpha::marks_unknown), "#??\n");
  cv::Mat deep;
  picture.convertTo(deep, CV_16U, 257);
  EXPECT_EQ(cellsOf(pngBytes(deep), {}, Picture::Alpha::marks_unknown), "#??\n");
}

TEST(Picture, IncludesTheThresholdsOnRequest) {
  // p = 1, 0.6 and 0 with the thresholds 0.6 and 0, or 1 and 0.6
  const std::string grays = "P2 3 1 255  0 102 255";
  EXPECT_EQ(cellsOf(grays, {.thresholds = {0.6, 0, true}}), "##.\n");
  EXPECT_EQ(cellsOf(grays, {.thresholds = {1, 0.6, true}}), "#..\n");
  EXPECT_EQ(cellsOf(grays, {.thresholds = {1, 0, true}}), "#?.\n");
  EXPECT_EQ(cellsOf(grays, {.thresholds = {1, 0, false}}), "???\n");
}

std::string littleEndian(std::uint32_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
  return text;
}

/// A BMP file with a header of 40 bytes.
/// @param after_header masks or a palette
std::string bmp(std::uint32_t columns, std::uint32_t rows, std::uint32_t bits, const std::string& pixels,
                const std::string& after_header = "", std::uint32_t compression = 0) {
  const auto at = static_cast<std::uint32_t>(54 + after_header.size());
  return "BM" + littleEndian(at + static_cast<std::uint32_t>(pixels.size()), 4) + std::string(4, '\0') +
         littleEndian(at, 4) + littleEndian(40, 4) + littleEndian(columns, 4) + littleEndian(rows, 4) +
         littleEndian(1, 2) + littleEndian(bits, 2) + littleEndian(compression, 4) + std::string(20, '\0') +
         after_header + pixels;
}

TEST(Picture, ReadsBmpOfAllDepths) {
  // The lower row comes first, each filled to a multiple of 4 bytes.
  const std::string black(3, '\0'), white(3, '\xff'), gray(3, '\x80');
  EXPECT_EQ(cellsOf(bmp(2, 2, 24, white + gray + "zz" + black + white + "zz")), "#.\n.?\n");
  EXPECT_EQ(cellsOf(bmp(2, static_cast<std::uint32_t>(-2), 24, white + gray + "zz" + black + white + "zz")), ".?\n#.\n")
      << "from the top";
  const std::string palette = littleEndian(0xffffff, 4) + littleEndian(0, 4);
  EXPECT_EQ(cellsOf(bmp(3, 1, 1, std::string("\x40\0\0\0", 4), palette)), ".#.\n");
  EXPECT_EQ(cellsOf(bmp(3, 1, 4, std::string("\x01\x10\0\0", 4), palette + std::string(56, '\0'))), ".##\n");
  EXPECT_EQ(cellsOf(bmp(3, 1, 8, std::string("\0\1\0\0", 4), palette + std::string(1016, '\0'))), ".#.\n");
  EXPECT_EQ(cellsOf(bmp(2, 1, 16, std::string("\xff\x7f\0\0", 4))), ".#\n");
  EXPECT_EQ(cellsOf(bmp(2, 1, 32, white + "z" + black + "z")), ".#\n") << "the fourth byte is unused";
  const std::string masks = littleEndian(0xff, 4) + littleEndian(0xff00, 4) + littleEndian(0xff0000, 4);
  EXPECT_EQ(cellsOf(bmp(2, 1, 32, white + "z" + black + "z", masks, 3)), ".#\n");
}

TEST(Picture, RejectsBmpThatIsCutOffCompressedOrOfAnUnknownForm) {
  const auto fault_of = [](const std::string& bytes) -> std::string {
    try {
      cellsOf(bytes);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(fault_of(bmp(2, 2, 24, std::string(15, '\0'))), "a: is cut off: its pixels take 16 bytes from byte 54");
  EXPECT_EQ(fault_of(bmp(2, 2, 8, std::string(8, '\0'), std::string(1024, '\0'), 1)),
            "a: is a compressed BMP picture; save it without compression");
  EXPECT_EQ(fault_of(bmp(2, 2, 7, std::string(8, '\0'))),
            "a: has 7 bits per pixel; it must have 1, 4, 8, 16, 24 or 32");
  EXPECT_NE(fault_of(bmp(100'000, 100'000, 24, "")).find("a map may have"), std::string::npos);
  const std::string whole = bmp(2, 2, 8, std::string(8, '\0'), std::string(1024, '\0'));
  for (std::size_t size = 2; size < whole.size(); ++size) {
    EXPECT_NE(fault_of(whole.substr(0, size)), "none") << size;
  }
}

TEST(Picture, ReadsJpegAndReportsItsDamage) {
  // Blocks of 8 × 8 pixels, without loss
  std::vector<std::uint8_t> values;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 16; ++column) values.push_back(column < 8 ? 0 : 255);
  }
  const std::string file = jpegBytes(16, 8, 1, values);
  std::string cells;
  for (int row = 0; row < 8; ++row) cells += "########........\n";
  EXPECT_EQ(cellsOf(file), cells);
  try {
    cellsOf(file.substr(0, file.size() - 20));
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "a: is a damaged JPEG picture: Premature end of JPEG file");
  }
}

TEST(Picture, DecidesAtTheThresholdsAsMapServerDoes) {
  // p = (255 - x) / 255: above occupied is occupied, below free is free, at either is unknown.
  const std::string grays = "P2 5 1 255  127 128 153 204 205";
  EXPECT_EQ(cellsOf(grays, {.thresholds = {.occupied = 0.5, .free = 0.2}}), "#???.\n");
  EXPECT_EQ(cellsOf(grays, {.thresholds = {.occupied = 0.4, .free = 0.4}}), "##?..\n");
  EXPECT_EQ(cellsOf(grays, {.thresholds = {.occupied = 0.5, .free = 0.4}, .negate = true}), "?####\n");
  EXPECT_EQ(cellsOf("P2 4 1 255  0 50 100 101", {.thresholds = {}, .is_percent = true}), ".?#?\n");
}

TEST(Picture, ConvertsEveryPixelByTheRuleOfMapServer) {
  Rng rng(1, RandomPurpose::test);
  cv::Mat picture(40, 30, CV_8UC3);
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      for (int i = 0; i < 3; ++i) picture.at<cv::Vec3b>(row, column)[i] = static_cast<std::uint8_t>(rng.below(256));
    }
  }
  const OccupancyThresholds thresholds{0.55, 0.35};
  const OccupancyGrid grid = gridOf(readPicture(pngBytes(picture), "a", Picture::Alpha::counts), {thresholds});
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const auto& pixel = picture.at<cv::Vec3b>(row, column);
      const double p = (255 - (pixel[0] + pixel[1] + pixel[2]) / 3.0) / 255.0;
      const auto expected = p > 0.55 ? Occupancy::occupied : p < 0.35 ? Occupancy::free : Occupancy::unknown;
      ASSERT_EQ(grid.at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(39 - row)), expected);
    }
  }
}

TEST(Picture, CountsOnlyRedForStage) {
  // Red, yellow and half-transparent black, in OpenCV's order blue, green, red: only the last is dark in red.
  cv::Mat png(1, 4, CV_8UC4);
  png.at<cv::Vec4b>(0, 0) = {0, 0, 255, 255};
  png.at<cv::Vec4b>(0, 1) = {0, 0, 128, 255};
  png.at<cv::Vec4b>(0, 2) = {255, 255, 127, 255};
  png.at<cv::Vec4b>(0, 3) = {0, 0, 0, 10};
  const PixelInterpretation stage{.thresholds = kStageThresholds};
  EXPECT_EQ(cellsOf(pngBytes(png), stage, Picture::Alpha::only_red), "..##\n");
  EXPECT_EQ(cellsOf("P3 3 1 255  255 0 0  127 255 255  128 0 0", stage, Picture::Alpha::only_red), ".#.\n");
  EXPECT_EQ(cellsOf("P2 3 1 255  127 128 205", stage, Picture::Alpha::only_red), "#..\n");
}

}  // namespace
}  // namespace robosim
