#include "world/maps/map_writer.h"

#include <cmath>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>
#define OCTOMAP_NODEBUGOUT  // otherwise it logs to standard error
#include <octomap/OcTree.h>

#include "base/random.h"
#include "geometry/testing/random_scene.h"
#include "world/maps/testing/map_samples.h"
#include "world/testing/random_grid.h"

namespace robosim {
namespace {

constexpr double kTouch_m = 1e-7;  ///< what the writers take for a touch

World emptyWorld(const Bounds2D& bounds) {
  World world;
  world.bounds = bounds;
  return world;
}

void add(World& world, const Solid& solid) {
  Body body;
  body.center_z_m = (solid.heights.z_min_m + solid.heights.z_max_m) / 2;
  body.height_m = solid.heights.z_max_m - solid.heights.z_min_m;
  if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
    body.shape = Cylinder{circle->radius_m};
    body.world_from_body = {circle->center.x, circle->center.y, 0};
  } else {
    const auto& box = std::get<OrientedBox>(solid.outline);
    body.shape = Cube{2 * box.half_length_m, 2 * box.half_width_m};
    body.world_from_body = {box.center.x, box.center.y, std::atan2(box.axis.y, box.axis.x)};
  }
  world.objects.push_back({.name = "thing", .body = body, .line = {}});
}

World randomWorld(Rng& rng) {
  World world = emptyWorld({-rng.uniform(1, 3), rng.uniform(1, 3), -rng.uniform(1, 3), rng.uniform(1, 3)});
  const SolidSpread spread{
      .area = {-3, 3, -3, 3}, .size_min_m = 0.002, .size_max_m = 1.5, .lattice_m = rng.below(2) ? 0.125 : 0};
  for (const auto& solid : randomSolids(rng, rng.below(12), spread)) add(world, solid);
  return world;
}

/// A box shrunk by `by_m` on all sides.
Solid cuboid(double x, double y, double z, double side_m, double height_m, double by_m) {
  return {OrientedBox{{x + side_m / 2, y + side_m / 2}, {1, 0}, side_m / 2 - by_m, side_m / 2 - by_m},
          {z + by_m, z + height_m - by_m}};
}

/// Expected state of a region of space, by a loop over all solids: occupied when a solid overlaps it by more than the
/// tolerance; nullopt when the result depends on the tolerance.
std::optional<Occupancy> slowly(const std::vector<Solid>& solids, const Bounds2D& surface, const HeightSpan& heights,
                                double x, double y, double z, double side_m, double height_m) {
  const auto overlaps = [&](double by_m) {
    const Solid piece = cuboid(x, y, z, side_m, height_m, by_m);
    return std::any_of(solids.begin(), solids.end(),
                       [&](const Solid& solid) { return solid.heights.overlaps(heights) && overlap(piece, solid); });
  };
  const auto is_over = [&](double by_m) {
    return x + by_m < surface.x_max && surface.x_min < x + side_m - by_m && y + by_m < surface.y_max &&
           surface.y_min < y + side_m - by_m && z + by_m < heights.z_max_m && heights.z_min_m < z + height_m - by_m;
  };
  const auto known = [&](double by_m) {
    if (overlaps(by_m)) return Occupancy::occupied;
    return is_over(by_m) ? Occupancy::free : Occupancy::unknown;
  };
  const Occupancy strict = known(2 * kTouch_m), tolerant = known(kTouch_m / 100);
  return strict == tolerant ? std::optional(strict) : std::nullopt;
}

TEST(Raster, MarksEveryCellThatAWallOverlaps) {
  World world = emptyWorld({0, 1, 0, 0.75});
  add(world, cuboid(0.25, 0.25, 0, 0.25, 1, 0));                        // fills one cell, touches eight
  add(world, {OrientedBox{{0.75, 0.7}, {1, 0}, 0.05, 0.001}, {0, 1}});  // 2 mm thin, across a border
  EXPECT_EQ(drawn(rasterize(world, {0.25, {0, 1}})), "..##\n.#..\n....\n");
}

TEST(Raster, ContainsOnlySolidsWithinTheHeights) {
  World world = emptyWorld({0, 1, 0, 0.25});
  add(world, cuboid(0, 0, 0, 0.25, 0.3, 0));      // a step
  add(world, cuboid(0.25, 0, 0.3, 0.25, 2, 0));   // over it
  add(world, cuboid(0.5, 0, 1.5, 0.25, 0.2, 0));  // above the heights
  EXPECT_EQ(drawn(rasterize(world, {0.25, {0, 0.3}})), "#...\n");
  EXPECT_EQ(drawn(rasterize(world, {0.25, {0.3, 1.5}})), ".#..\n");
  EXPECT_EQ(drawn(rasterize(world, {0.25, {0, 3}})), "###.\n");
}

TEST(Raster, IsUnknownBeyondTheSurfaceExceptForSolids) {
  World world = emptyWorld({0, 0.5, 0, 0.5});
  add(world, cuboid(0.75, 0.75, 0, 0.25, 1, 0));
  const OccupancyGrid grid = rasterize(world, {0.25, {0, 1}});
  EXPECT_EQ(drawn(grid), "???#\n????\n..??\n..??\n");
  EXPECT_EQ(grid.map_from_grid, mrpt::math::TPose2D(0, 0, 0));
}

TEST(Raster, AgreesWithALoopOverAllSolidsCellByCell) {
  std::size_t counted[3] = {0, 0, 0}, in_doubt = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    const World world = randomWorld(rng);
    const double cells_m[] = {0.25, 0.1, 0.37};
    const MapExtent extent{cells_m[rng.below(3)], {0.2, 0.2 + rng.uniform(0.1, 2)}};
    const auto solids = startSolids(world);
    const OccupancyGrid grid = rasterize(world, extent);
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
      for (std::uint32_t column = 0; column < grid.columns; ++column) {
        const auto expected = slowly(solids, world.bounds, extent.heights, grid.map_from_grid.x + column * grid.cell_m,
                                     grid.map_from_grid.y + row * grid.cell_m, extent.heights.z_min_m, grid.cell_m,
                                     extent.heights.z_max_m - extent.heights.z_min_m);
        if (expected) {
          ASSERT_EQ(grid.at(column, row), *expected) << "seed " << seed << " " << column << " " << row;
        }
        ++(expected ? counted[static_cast<std::size_t>(*expected)] : in_doubt);
      }
    }
  }
  for (const auto count : counted) EXPECT_GT(count, 5'000u);
  EXPECT_LT(in_doubt, 100u);
}

TEST(Raster, ReproducesTheCellsOfAMap) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    OccupancyGrid grid = randomGrid(rng, 5 + rng.below(40), 5 + rng.below(40), 0.05);
    grid.map_from_grid = {0.05 * (static_cast<double>(rng.below(100)) - 50), 0.05 * rng.below(100), 0};
    World world;
    world.maps.emplace_back();
    world.maps[0].plan = toFloorPlan(grid, false);
    world.bounds = boundsOf(world.maps[0].plan, {});
    const OccupancyGrid again = rasterize(world, {0.05, {0, 1}});
    ASSERT_EQ(drawn(again), drawn(grid)) << "seed " << seed;
    EXPECT_NEAR(again.map_from_grid.x, grid.map_from_grid.x, 1e-12);
    EXPECT_NEAR(again.map_from_grid.y, grid.map_from_grid.y, 1e-12);
  }
}

TEST(Raster, AlignsWithTheCellsOfTheMap) {
  // Cells of 0.05 m from (0.02, -0.03) on; multiples of 0.05 m would cut every one of them in four.
  Rng rng(1, RandomPurpose::test);
  OccupancyGrid grid = randomGrid(rng, 20, 30, 0.05);
  grid.map_from_grid = {0.02, -0.03, 0};
  World world;
  world.maps.emplace_back();
  world.maps[0].plan = toFloorPlan(grid, false);
  world.bounds = boundsOf(world.maps[0].plan, {});
  MapExtent extent = *extentOfMap(world);
  extent.heights = {0, 1};
  const OccupancyGrid again = rasterize(world, extent);
  EXPECT_EQ(drawn(again), drawn(grid));
  EXPECT_EQ(again.cell_m, 0.05);
  EXPECT_NEAR(again.map_from_grid.x, 0.02, 1e-12);
  EXPECT_NEAR(again.map_from_grid.y, -0.03, 1e-12);
}

TEST(MapExtent, IsAbsentWithoutAnUnrotatedMapWithCells) {
  World world;
  EXPECT_FALSE(extentOfMap(world));
  world.maps.emplace_back();
  EXPECT_FALSE(extentOfMap(world)) << "a map without cells";
  world.maps[0].plan.columns = world.maps[0].plan.rows = 2;
  world.maps[0].plan.cell_m = 0.1;
  world.maps[0].world_from_map = {1, 2, 0.5};
  EXPECT_FALSE(extentOfMap(world)) << "turned";
  world.maps[0].world_from_map.phi = 0;
  EXPECT_EQ(extentOfMap(world)->cell_m, 0.1);
  EXPECT_EQ(extentOfMap(world)->origin, mrpt::math::TPoint2D(1, 2));
}

TEST(GridmapWriter, CompressesReadably) {
  Rng rng(1, RandomPurpose::test);
  const OccupancyGrid grid = randomGrid(rng, 200, 300, 0.05);
  const std::string bytes = toGridmap(grid), compressed = gzipped(bytes);
  EXPECT_LT(compressed.size(), bytes.size() / 2);
  EXPECT_EQ(drawn(readGridmap(compressed, "a.gridmap.gz", {})), drawn(readGridmap(bytes, "a.gridmap", {})));
}

TEST(Raster, IsRejectedAboveTheCellLimit) {
  const World world = emptyWorld({0, 100, 0, 100});
  try {
    rasterize(world, {0.001, {0, 1}});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "cells of 0.001 m make a grid of 100000 × 100000; a map may have 67108864 at most, so make them larger");
  }
}

OccupancyGrid sampleRaster() {
  Rng rng(7, RandomPurpose::test);
  World world = randomWorld(rng);
  add(world, cuboid(3.1, 0, 0, 0.3, 1, 0));
  return rasterize(world, {0.05, {0, 1}});
}

TEST(GridmapWriter, IsReadByMrptCellByCell) {
  const OccupancyGrid grid = sampleRaster();
  const std::string bytes = toGridmap(grid);
  mrpt::io::CMemoryStream stream;
  stream.assignMemoryNotOwn(bytes.data(), bytes.size());
  mrpt::maps::COccupancyGridMap2D theirs;
  mrpt::serialization::archiveFrom(stream) >> theirs;
  ASSERT_EQ(theirs.getSizeX(), grid.columns);
  ASSERT_EQ(theirs.getSizeY(), grid.rows);
  EXPECT_EQ(theirs.getResolution(), 0.05f);
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const float free = theirs.getCell(static_cast<int>(column), static_cast<int>(row));
      const auto expected = grid.at(column, row);
      ASSERT_NEAR(free, expected == Occupancy::free ? 1 : expected == Occupancy::unknown ? 0.5 : 0, 1e-3);
      EXPECT_NEAR(theirs.idx2x(static_cast<int>(column)), grid.map_from_grid.x + (column + 0.5) * 0.05, 1e-5);
      EXPECT_NEAR(theirs.idx2y(static_cast<int>(row)), grid.map_from_grid.y + (row + 0.5) * 0.05, 1e-5);
    }
  }
}

TEST(GridmapWriter, RoundTripsThroughTheReader) {
  const OccupancyGrid grid = sampleRaster();
  const OccupancyGrid again = readGridmap(toGridmap(grid), "a.gridmap", {});
  EXPECT_EQ(drawn(again), drawn(grid));
  EXPECT_NEAR(again.map_from_grid.x, grid.map_from_grid.x, 1e-6);
  EXPECT_EQ(again.cell_m, 0.05);
}

TEST(GridmapWriter, RejectsCellsBelowSinglePrecision) {
  OccupancyGrid grid = sampleRaster();
  grid.map_from_grid.x = 4'000'000;
  try {
    toGridmap(grid);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "MRPT's grid maps count in single precision, which cannot resolve cells of 0.05 m so far from the "
                 "origin; make them larger, or move the world");
  }
}

TEST(RosMapWriter, WritesTheFormatOfMapServer) {
  OccupancyGrid grid = sampleRaster();
  grid.map_from_grid = {-3 * 0.7, 12.5, 0};  // -2.0999999999999996
  const RosMap map = toRosMap(grid, "my lab: 1.png");
  EXPECT_EQ(map.yaml,
            "image: \"my lab: 1.png\"\nresolution: 0.05\norigin: [-2.1, 12.5, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
            "free_thresh: 0.196\n");
  const OccupancyGrid again =
      readRosMap("a.yaml", makeProvider("world.xml", {{"a.yaml", map.yaml}, {"my lab: 1.png", map.png}}));
  EXPECT_EQ(drawn(again), drawn(grid));
  EXPECT_EQ(again.map_from_grid, mrpt::math::TPose2D(-2.1, 12.5, 0));
}

/// The tree as read by octomap.
std::unique_ptr<octomap::OcTree> octreeIn(const std::string& bytes, OctomapForm form) {
  std::istringstream in(bytes);
  if (form == OctomapForm::probabilities) {
    return std::unique_ptr<octomap::OcTree>(dynamic_cast<octomap::OcTree*>(octomap::AbstractOcTree::read(in)));
  }
  auto tree = std::make_unique<octomap::OcTree>(1.0);
  EXPECT_TRUE(tree->readBinary(in));
  return tree;
}

Occupancy at(const octomap::OcTree& tree, double x, double y, double z) {
  const octomap::OcTreeNode* node = tree.search(x, y, z);
  if (!node) return Occupancy::unknown;
  return tree.isNodeOccupied(node) ? Occupancy::occupied : Occupancy::free;
}

TEST(OctomapWriter, AgreesWithALoopOverAllSolidsVoxelByVoxel) {
  std::size_t counted[3] = {0, 0, 0}, in_doubt = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    const World world = randomWorld(rng);
    const double voxels_m[] = {0.25, 0.2, 0.37};
    const MapExtent extent{voxels_m[rng.below(3)], {0.2, 0.2 + rng.uniform(0.1, 2)}};
    const auto solids = startSolids(world);
    const auto form = rng.below(2) ? OctomapForm::binary : OctomapForm::probabilities;
    const auto tree = octreeIn(toOctomap(world, extent, form, [](double) {}), form);
    ASSERT_TRUE(tree);
    EXPECT_EQ(tree->getResolution(), extent.cell_m);
    const double v = extent.cell_m;
    for (int x = -20; x < 20; ++x) {
      for (int y = -20; y < 20; ++y) {
        for (int z = -2; z < 14; ++z) {
          const auto expected = slowly(solids, world.bounds, extent.heights, x * v, y * v, z * v, v, v);
          if (expected) {
            ASSERT_EQ(at(*tree, (x + 0.5) * v, (y + 0.5) * v, (z + 0.5) * v), *expected)
                << "seed " << seed << " " << x << " " << y << " " << z;
          }
          ++(expected ? counted[static_cast<std::size_t>(*expected)] : in_doubt);
        }
      }
    }
  }
  for (const auto count : counted) EXPECT_GT(count, 2'000u);
  EXPECT_LT(in_doubt, 100u);
}

TEST(OctomapWriter, MergesLargeUniformSpaces) {
  World world = emptyWorld({-12.8, 12.8, -12.8, 12.8});
  const auto tree =
      octreeIn(toOctomap(world, {0.05, {0, 1.6}}, OctomapForm::binary, [](double) {}), OctomapForm::binary);
  EXPECT_EQ(tree->getNumLeafNodes(), 16u * 16u) << "of 1.6 m, not 512 × 512 × 32 of 5 cm";
}

TEST(OctomapWriter, ReportsProgress) {
  World world = emptyWorld({-3, 3, -3, 3});
  for (int i = 0; i < 40; ++i) add(world, {Circle{{i * 0.1 - 2, 0.05 * i - 1}, 0.3}, {0, 1}});
  std::vector<double> reported;
  toOctomap(world, {0.02, {0, 1}}, OctomapForm::binary, [&](double share) { reported.push_back(share); });
  ASSERT_GT(reported.size(), 10u);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_LE(reported.back(), 1);
  EXPECT_GT(reported.back(), 0.9);
}

TEST(OctomapWriter, RejectsAWorldBeyondItsExtent) {
  try {
    toOctomap(emptyWorld({0, 400, 0, 10}), {0.01, {0, 1}}, OctomapForm::binary, [](double) {});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "an OctoMap of 0.01 m voxels reaches 327.68 m from the origin, and the world reaches further; make them "
        "larger, or move the world");
  }
}

TEST(OctomapWriter, RejectsTooManyVoxels) {
  World world = emptyWorld({-5, 5, -5, 5});
  world.objects.push_back({.name = "Box", .body = {Cube{8, 8}, {0, 0, 0}, 0.5, 1, {}, 0}, .line = {}});
  try {
    toOctomap(world, {0.0025, {0, 1}}, OctomapForm::binary, [](double) {});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "an OctoMap of 0.0025 m voxels would have some 26 million on the faces of solids; make them larger");
  }
}

TEST(MapExtent, CoversTheHeightsOfRobotsAndObjects) {
  EXPECT_EQ(robotHeights({}), (HeightSpan{0, 1}));
  EXPECT_EQ(robotHeights({{0.1, 0.4}, {0, 0.3}}), (HeightSpan{0, 0.4}));
  World world = emptyWorld({0, 1, 0, 1});
  EXPECT_EQ(heightsOfAll(world), (HeightSpan{0, 1}));
  add(world, cuboid(0, 0, 0.5, 1, 2, 0));
  EXPECT_EQ(heightsOfAll(world), (HeightSpan{0, 2.5}));
  world.maps.emplace_back().height_m = 3;
  EXPECT_EQ(heightsOfAll(world), (HeightSpan{0, 3}));
}

}  // namespace
}  // namespace robosim
