#include <cstring>

#include <gtest/gtest.h>

#include "base/random.h"
#include "world/maps/testing/map_samples.h"

namespace robosim {
namespace {

using mrpt::maps::COccupancyGridMap2D;

void append(std::string& bytes, const auto& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

TEST(Gridmap, EqualsMrptsMapCellByCell) {
  Rng rng(1, RandomPurpose::test);
  COccupancyGridMap2D grid(-1.25f, 2, -1, 1.5f, 0.05f);
  for (unsigned y = 0; y < grid.getSizeY(); ++y) {
    for (unsigned x = 0; x < grid.getSizeX(); ++x) {
      grid.setCell(static_cast<int>(x), static_cast<int>(y), static_cast<float>(rng.uniform()));
    }
  }
  const OccupancyThresholds thresholds{0.6, 0.3};
  const OccupancyGrid read = readGridmap(gridmapBytes(grid), "a.gridmap", thresholds);
  ASSERT_EQ(read.columns, grid.getSizeX());
  ASSERT_EQ(read.rows, grid.getSizeY());
  EXPECT_EQ(read.cell_m, 0.05) << "not the double nearest to the float";
  EXPECT_EQ(read.map_from_grid, mrpt::math::TPose2D(-1.25, -1, 0));
  for (std::uint32_t y = 0; y < read.rows; ++y) {
    for (std::uint32_t x = 0; x < read.columns; ++x) {
      const double occupied = 1.0 - grid.getCell(static_cast<int>(x), static_cast<int>(y));
      ASSERT_EQ(read.at(x, y), thresholds.of(occupied)) << x << " " << y;
    }
  }
}

TEST(Gridmap, IsUnknownWhereNothingWasInserted) {
  const COccupancyGridMap2D untouched(0, 1, 0, 0.5f, 0.5f);
  EXPECT_EQ(drawn(readGridmap(gridmapBytes(untouched), "a", {})), "??\n");
}

TEST(Gridmap, ReadsOlderVersionsAndSixteenBitCells) {
  const auto file = [](std::int8_t version, std::uint8_t bits, const std::string& cells) {
    std::string bytes =
        "\x93"
        "COccupancyGridMap2D";
    append(bytes, version);
    append(bytes, bits);
    append(bytes, std::uint32_t{3});
    append(bytes, std::uint32_t{1});
    for (const float value : {0.0f, 0.3f, 0.0f, 0.1f, 0.1f}) append(bytes, value);
    return bytes + cells + "options\x88";
  };
  const std::string probabilities("\x00\x80\xff", 3);     // of being free
  const std::string odds("\x81\x00\x7f", 3);              // the logarithm of that
  const std::string wide("\x77\x81\x00\x00\x77\x7f", 6);  // the upper byte decides
  EXPECT_EQ(drawn(readGridmap(file(2, 8, probabilities), "a", {})), "#?.\n");
  EXPECT_EQ(drawn(readGridmap(file(3, 8, odds), "a", {})), "#?.\n");
  EXPECT_EQ(drawn(readGridmap(file(6, 16, wide), "a", {})), "#?.\n");
}

}  // namespace
}  // namespace robosim
