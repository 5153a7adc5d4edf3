#include <sstream>

#define OCTOMAP_NODEBUGOUT  // otherwise it logs to standard error
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include "base/random.h"
#include "world/maps/testing/map_samples.h"

namespace robosim {
namespace {

template <typename Tree>
std::string otBytes(const Tree& tree) {
  std::ostringstream out;
  tree.write(out);
  return out.str();
}
std::string btBytes(octomap::OcTree tree) {
  std::ostringstream out;
  tree.writeBinary(out);
  return out.str();
}

/// Voxels of 0.25 m, at random, pruned: some lie in cubes of several voxels.
octomap::OcTree randomTree() {
  octomap::OcTree tree(0.25);
  Rng rng(1, RandomPurpose::test);
  for (int x = -12; x < 20; ++x) {
    for (int y = -8; y < 8; ++y) {
      for (int z = -4; z < 8; ++z) {
        const octomap::point3d center((static_cast<float>(x) + 0.5f) / 4, (static_cast<float>(y) + 0.5f) / 4,
                                      (static_cast<float>(z) + 0.5f) / 4);
        const bool is_block = x < -4 && y < 0 && z < 4;
        const double chance = is_block ? 0 : rng.uniform();
        if (chance < 0.8) tree.updateNode(center, is_block || chance < 0.05);
      }
    }
  }
  tree.prune();
  return tree;
}

/// State of a column of voxels in a slice, by OctoMap's own queries.
Occupancy columnOf(const octomap::OcTree& tree, double x, double y, double z_min, double z_max) {
  Occupancy state = Occupancy::unknown;
  for (double z = z_min + 0.125; z < z_max; z += 0.25) {
    const octomap::OcTreeNode* node = tree.search(x, y, z);
    if (!node) continue;
    if (tree.isNodeOccupied(node)) return Occupancy::occupied;
    state = Occupancy::free;
  }
  return state;
}

TEST(Octomap, HasTheCellsThatOctoMapFindsInTheSlice) {
  octomap::OcTree tree = randomTree();
  const OccupancyGrid read = readOctomap(otBytes(tree), "a.ot", {0.25, 1});
  EXPECT_EQ(read.cell_m, 0.25);
  EXPECT_EQ(read.columns, 32u);
  EXPECT_EQ(read.rows, 16u);
  EXPECT_EQ(read.map_from_grid, mrpt::math::TPose2D(-3, -2, 0));
  const auto check = [](const OccupancyGrid& grid, const octomap::OcTree& judge) {
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
      for (std::uint32_t column = 0; column < grid.columns; ++column) {
        const double x = grid.map_from_grid.x + 0.25 * column + 0.125, y = grid.map_from_grid.y + 0.25 * row + 0.125;
        ASSERT_EQ(grid.at(column, row), columnOf(judge, x, y, 0.25, 1)) << x << " " << y;
      }
    }
  };
  check(read, tree);
  octomap::OcTree stored(0.25);
  std::istringstream binary(btBytes(tree));
  ASSERT_TRUE(stored.readBinary(binary));
  const OccupancyGrid of_bt = readOctomap(btBytes(tree), "a.bt", {0.25, 1});
  EXPECT_EQ(of_bt.cells.size(), read.cells.size());
  check(of_bt, stored);
}

TEST(Octomap, CountsVoxelsThatReachIntoTheSliceButNotThoseThatTouchIt) {
  octomap::OcTree tree(0.5);
  tree.updateNode(octomap::point3d(0.25f, 0.25f, 0.25f), true);  // from 0 to 0.5 m
  tree.updateNode(octomap::point3d(0.75f, 0.25f, 0.25f), false);
  tree.updateNode(octomap::point3d(0.75f, 0.25f, 0.75f), true);  // from 0.5 to 1 m
  tree.updateNode(octomap::point3d(1.75f, 0.25f, 0.75f), false);
  const std::string bytes = otBytes(tree);
  EXPECT_EQ(drawn(readOctomap(bytes, "a", {0.1, 0.5})), "#.\n");
  EXPECT_EQ(drawn(readOctomap(bytes, "a", {0.1, 0.6})), "##?.\n");
  EXPECT_EQ(drawn(readOctomap(bytes, "a", {0.5, 1})), "#?.\n");
}

TEST(Octomap, ReadsTreesWithColoursToo) {
  octomap::ColorOcTree tree(0.5);
  tree.updateNode(octomap::point3d(0.25f, 0.25f, 0.25f), true);
  tree.setNodeColor(0.25f, 0.25f, 0.25f, 1, 2, 3);
  tree.updateNode(octomap::point3d(0.75f, 0.25f, 0.25f), false);
  EXPECT_EQ(drawn(readOctomap(otBytes(tree), "a", {0.1, 0.5})), "#.\n");
}

TEST(Octomap, GivesItsCubesToTheWorld) {
  octomap::OcTree tree(0.5);
  tree.updateNode(octomap::point3d(0.25f, 0.25f, 0.25f), true);
  useMapFormats();
  const FileTexts files{{"a.bt", btBytes(tree)}};
  const FloorPlan plan = readMap("a.bt", makeProvider("world.xml", files), {});
  EXPECT_EQ(plan.occupied, (std::vector<CellRectangle>{{0, 0, 1, 1}}));
  EXPECT_EQ(plan.warnings, std::vector<std::string>{"has no free cell, and so no known place for a robot; check the "
                                                    "z_min and z_max of its <map>"});
}

TEST(Octomap, SaysWhatIsWrongWithAFile) {
  const std::string at = "maps/a.bt: ";
  const auto fault = [](const std::string& bytes) {
    const auto faults = faultsOf("a.bt", {{"a.bt", bytes}});
    return faults.empty() ? "" : faults[0];
  };
  const std::string good = btBytes(randomTree());
  EXPECT_EQ(fault(good), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(fault("<world/>"), at + "is no OctoMap: it does not begin with \"# Octomap OcTree\"");
  EXPECT_EQ(fault(good.substr(0, 40)), at + "is cut off: the line \"data\" is missing");
  EXPECT_EQ(fault(with("id OcTree", "id Voxels")),
            at + "has the id 'Voxels'; OcTree, ColorOcTree and OcTreeStamped are read");
  EXPECT_EQ(fault(with("res 0.25", "res x")), at + "has no res in (0, 100] metres, the side of its voxels");
  EXPECT_EQ(
      fault(good.substr(0, good.size() - 1)),
      at + "is cut off: its voxels end at byte " + std::to_string(good.size() - 1) + ", in the middle of the tree");
  const std::string head = "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.5\ndata\n";
  EXPECT_EQ(fault(head + std::string(2, '\0')), at + "has no voxel that is free or occupied");
  EXPECT_EQ(fault(head + std::string(64, '\xff')), at + "is damaged: at byte " + std::to_string(head.size() + 32) +
                                                       " a voxel is divided below the smallest size");
  EXPECT_EQ(fault(head + std::string("\x02\0", 2)),
            at + "has no voxels between 0.1 m and 1 m; they reach from -16384 m to 0 m: write a world with z_min and "
                 "z_max in its <map>");
  EXPECT_EQ(fault(head + std::string("\x55\x55", 2)),
            at + "has 65536 × 65536 cells in the slice; a map may have 67108864 at most");
}

}  // namespace
}  // namespace robosim
