#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/temporary_directory.h"
#include "world/maps/testing/map_samples.h"

namespace robosim {
namespace {

OccupancyGrid readFrom(const FileTexts& files) { return readRosMap("lab/a.yaml", makeProvider("world.xml", files)); }

TEST(RosMap, ReadsItsPictureRelativeToItsFolder) {
  const OccupancyGrid grid =
      readFrom({{"lab/a.yaml", rosYaml("pictures/a.pgm")}, {"lab/pictures/a.pgm", "P2 3 2 255  0 205 254  254 254 0"}});
  EXPECT_EQ(drawn(grid), "#?.\n..#\n");
  EXPECT_EQ(grid.cell_m, 0.05);
  EXPECT_EQ(grid.map_from_grid, mrpt::math::TPose2D(-1.5, 2, 0));
}

TEST(RosMap, ReadsPicturesInJpegAndBmp) {
  // Blocks of 8 × 8 pixels, which JPEG keeps: black, white.
  cv::Mat picture(8, 16, CV_8UC3, cv::Scalar(0, 0, 0));
  picture(cv::Rect(8, 0, 8, 8)).setTo(cv::Scalar(255, 255, 255));
  for (const std::string ending : {".jpg", ".bmp", ".png"}) {
    std::vector<unsigned char> bytes;
    cv::imencode(ending, picture, bytes);
    const OccupancyGrid grid =
        readFrom({{"lab/a.yaml", rosYaml("a" + ending)}, {"lab/a" + ending, {bytes.begin(), bytes.end()}}});
    const std::string row = "########........\n";
    EXPECT_EQ(drawn(grid), row + row + row + row + row + row + row + row) << ending;
  }
}

TEST(RosMap, SupportsRotationNegationScaleAndRawModes) {
  const auto yaml = [](const std::string& end) {
    return "image: /abs/a.pgm\nresolution: 1e-1\norigin: [1, 2, 0.5]\noccupied_thresh: 0.6\nfree_thresh: 0.2\n" + end;
  };
  const std::string grays = "P2 4 1 255  0 64 100 255";
  const auto read = [&](const std::string& end) {
    return readFrom({{"lab/a.yaml", yaml(end)}, {"/abs/a.pgm", grays}});
  };
  EXPECT_EQ(read("negate: 0").map_from_grid, mrpt::math::TPose2D(1, 2, 0.5));
  EXPECT_EQ(drawn(read("negate: 0")), "###.\n");
  EXPECT_EQ(drawn(read("negate: true")), ".??#\n");
  EXPECT_EQ(drawn(read("negate: 0\nmode: scale")), "###.\n");
  EXPECT_EQ(drawn(read("negate: 0\nmode: raw")), ".##?\n");
  EXPECT_EQ(drawn(read("negate: 0\ncost: [unknown to us]")), "###.\n");
}

MapReading ofRos1() {
  MapReading reading;
  reading.is_of_ros1 = true;
  return reading;
}

/// Thresholds as in nav2's speed masks: only black is occupied, only white is free.
std::string maskYaml(const std::string& image) {
  return "image: " + image + "\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 1.0\nfree_thresh: 0.0\n";
}

TEST(RosMap, IncludesItsThresholdsAsNav2OrNotAsRos1) {
  const FileTexts texts{{"a.yaml", maskYaml("a.pgm")}, {"a.pgm", "P2 3 1 255  0 128 255"}};
  const FileProvider files = makeProvider("world.xml", texts);
  EXPECT_EQ(drawn(readRosMap("a.yaml", files)), "#?.\n");
  EXPECT_EQ(drawn(readRosMap("a.yaml", files, ofRos1())), "???\n");
}

TEST(RosMap, TakesTransparentPixelsForUnknownAsNav2OrAveragesAlphaAsRos1) {
  cv::Mat picture(1, 3, CV_8UC4);
  picture.at<cv::Vec4b>(0, 0) = {0, 0, 0, 255};  // ROS 1: an average of 64, p = 0.75
  picture.at<cv::Vec4b>(0, 1) = {0, 0, 0, 0};
  picture.at<cv::Vec4b>(0, 2) = {255, 255, 255, 255};
  for (const std::string mode : {"trinary", "scale"}) {
    const FileTexts texts{{"a.yaml", rosYaml("a.png") + "mode: " + mode + "\n"}, {"a.png", pngBytes(picture)}};
    const FileProvider files = makeProvider("world.xml", texts);
    const OccupancyGrid grid = readRosMap("a.yaml", files);
    EXPECT_EQ(drawn(grid), "#?.\n");
    EXPECT_EQ(grid.transparent, 1u);
    EXPECT_EQ(drawn(readRosMap("a.yaml", files, ofRos1())), "##.\n");
  }
}

std::vector<std::string> warningsOf(const FileTexts& files) {
  useMapFormats();
  return readMap("a.yaml", makeProvider("world.xml", files), {}).warnings;
}

TEST(RosMap, WarnsOfMapsWithoutWallsOrFreeCellsAndOfTransparentPixels) {
  const auto of_grays = [](const std::string& grays) {
    return warningsOf({{"a.yaml", rosYaml("a.pgm")}, {"a.pgm", "P2 2 1 255 " + grays}});
  };
  EXPECT_EQ(of_grays("0 255"), std::vector<std::string>());
  const std::string check = "; check its occupied_thresh, free_thresh and negate";
  EXPECT_EQ(of_grays("128 255"), std::vector<std::string>{"has no occupied cell, and so no walls" + check});
  EXPECT_EQ(of_grays("0 128"), std::vector<std::string>{"has no free cell, and so no known place for a robot" + check});
  cv::Mat picture(1, 3, CV_8UC4, cv::Scalar(0, 0, 0, 255));
  picture.at<cv::Vec4b>(0, 1) = {255, 255, 255, 255};
  picture.at<cv::Vec4b>(0, 2) = {0, 0, 0, 7};
  EXPECT_EQ(warningsOf({{"a.yaml", rosYaml("a.png")}, {"a.png", pngBytes(picture)}}),
            std::vector<std::string>{
                "has 1 transparent pixels, which are unknown cells, as in nav2; remove the picture's alpha channel, or "
                "set map_server=\"ros1\" in its <map>"});
}

TEST(RosMap, EqualsMrptsMapForBlackAndWhitePixels) {
  // MRPT stores a pixel's darkness without thresholds; for black and white pixels both must agree.
  const TemporaryDirectory folder;
  Rng rng(2, RandomPurpose::test);
  cv::Mat picture(30, 47, CV_8U);
  for (int i = 0; i < static_cast<int>(picture.total()); ++i) {
    picture.at<std::uint8_t>(i / 47, i % 47) = rng.below(2) ? 0 : 254;
  }
  const FileTexts files{{"a.yaml", rosYaml("a.png")}, {"a.png", pngBytes(picture)}};
  for (const auto& [name, text] : files) std::ofstream(folder / name, std::ios::binary) << text;
  mrpt::maps::COccupancyGridMap2D theirs;
  ASSERT_TRUE(theirs.loadFromROSMapServerYAML((folder / "a.yaml").string()));
  const OccupancyGrid ours = readRosMap("a.yaml", makeProvider("world.xml", files));
  ASSERT_EQ(ours.columns, theirs.getSizeX());
  ASSERT_EQ(ours.rows, theirs.getSizeY());
  EXPECT_NEAR(ours.map_from_grid.x, theirs.getXMin(), 1e-6);
  EXPECT_NEAR(ours.map_from_grid.y, theirs.getYMin(), 1e-6);
  for (std::uint32_t y = 0; y < ours.rows; ++y) {
    for (std::uint32_t x = 0; x < ours.columns; ++x) {
      const bool is_free = theirs.getCell(static_cast<int>(x), static_cast<int>(y)) > 0.5f;
      ASSERT_EQ(ours.at(x, y), is_free ? Occupancy::free : Occupancy::occupied) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace robosim
