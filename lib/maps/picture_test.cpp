#include "maps/picture.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "base/random.h"
#include "maps/testing/map_samples.h"

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

}  // namespace
}  // namespace robosim
