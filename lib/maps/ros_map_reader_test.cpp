#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/temporary_directory.h"
#include "maps/testing/map_samples.h"

namespace robosim {
namespace {

OccupancyGrid readFrom(const FileTexts& files) { return readRosMap("lab/a.yaml", providerOf("world.xml", files)); }

TEST(RosMap, ReadsItsPictureRelativeToItsFolder) {
  const OccupancyGrid grid =
      readFrom({{"lab/a.yaml", rosYaml("pictures/a.pgm")}, {"lab/pictures/a.pgm", "P2 3 2 255  0 205 254  254 254 0"}});
  EXPECT_EQ(drawn(grid), "#?.\n..#\n");
  EXPECT_EQ(grid.cell_m, 0.05);
  EXPECT_EQ(grid.map_from_grid, mrpt::math::TPose2D(-1.5, 2, 0));
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
  const OccupancyGrid ours = readRosMap("a.yaml", providerOf("world.xml", files));
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
