#include "world/floor_plan.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "geometry/scene.h"
#include "geometry/testing/random_scene.h"
#include "geometry/testing/slow_scene.h"
#include "world/testing/random_grid.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

OccupancyGrid gridOf(const std::vector<std::string>& rows_from_the_top) {
  OccupancyGrid grid{static_cast<std::uint32_t>(rows_from_the_top[0].size()),
                     static_cast<std::uint32_t>(rows_from_the_top.size()),
                     0.5,
                     {},
                     {}};
  for (auto row = rows_from_the_top.rbegin(); row != rows_from_the_top.rend(); ++row) {
    for (const char c : *row) {
      grid.cells.push_back(c == '#' ? Occupancy::occupied : c == '?' ? Occupancy::unknown : Occupancy::free);
    }
  }
  return grid;
}

std::vector<Solid> solidsOf(const FloorPlan& plan, const TPose2D& world_from_map, const HeightSpan& heights = {0, 1}) {
  std::vector<Solid> solids;
  addSolids(plan, world_from_map, heights, solids);
  return solids;
}

TEST(FloorPlan, MergesARoomsWallsIntoFourBoxes) {
  const FloorPlan plan = toFloorPlan(gridOf({"######",  //
                                             "#....#",  //
                                             "#....#",  //
                                             "######"}),
                                     false);
  EXPECT_EQ(plan.occupied, (std::vector<CellRectangle>{{0, 0, 6, 1}, {0, 1, 1, 2}, {5, 1, 1, 2}, {0, 3, 6, 1}}));
  EXPECT_EQ(plan.occupiedCells(), 16u);
}

TEST(FloorPlan, DoesNotMergeCellsThatTouchAtACorner) {
  const FloorPlan plan = toFloorPlan(gridOf({"#.#",  //
                                             ".#.",  //
                                             "#.#"}),
                                     false);
  EXPECT_EQ(plan.occupied.size(), 5u);
}

TEST(FloorPlan, TreatsUnknownAsFreeByDefault) {
  const OccupancyGrid grid = gridOf({"?#?"});
  EXPECT_EQ(toFloorPlan(grid, false).occupiedCells(), 1u);
  EXPECT_EQ(toFloorPlan(grid, true).occupiedCells(), 3u);
}

TEST(FloorPlan, KeepsUnknownCellsUnlessTheyCountAsOccupied) {
  OccupancyGrid grid{.columns = 3, .rows = 2, .cell_m = 1, .map_from_grid = {}, .cells = {}};
  grid.cells.assign(6, Occupancy::unknown);
  grid.cells[0] = Occupancy::free;
  EXPECT_EQ(toFloorPlan(grid, false).unknown, (std::vector<CellRectangle>{{1, 0, 2, 1}, {0, 1, 3, 1}}));
  EXPECT_TRUE(toFloorPlan(grid, true).unknown.empty());
}

TEST(FloorPlan, CoversExactlyTheOccupiedCellsOnce) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    const OccupancyGrid grid = randomGrid(rng, 1 + rng.below(30), 1 + rng.below(30), 1);
    const bool unknown_too = rng.below(2) == 1;
    std::vector<int> covered(grid.cells.size(), 0);
    for (const auto& box : toFloorPlan(grid, unknown_too).occupied) {
      for (auto row = box.row; row < box.row + box.rows; ++row) {
        for (auto column = box.column; column < box.column + box.columns; ++column) {
          ++covered.at(std::size_t{row} * grid.columns + column);
        }
      }
    }
    for (std::size_t i = 0; i < covered.size(); ++i) {
      const bool stands = grid.cells[i] == Occupancy::occupied || (unknown_too && grid.cells[i] == Occupancy::unknown);
      ASSERT_EQ(covered[i], stands ? 1 : 0) << "seed " << seed << " cell " << i;
    }
  }
}

TEST(FloorPlan, IsPlacedByTheGridsCorner) {
  OccupancyGrid grid = gridOf({".#"});
  grid.map_from_grid = {1, 2, M_PI / 2};
  // The map is rotated by another quarter and placed at (10, 0): its x axis is the world's y axis.
  const auto solids = solidsOf(toFloorPlan(grid, false), {10, 0, M_PI / 2});
  ASSERT_EQ(solids.size(), 1u);
  // In the grid the cell is [0.5, 1] × [0, 0.5]; in the map [0.5, 1] × [2.5, 3]; in the world [7, 7.5] × [0.5, 1].
  const Bounds2D b = boundsOf(solids[0].outline);
  EXPECT_NEAR(b.x_min, 7, 1e-8);
  EXPECT_NEAR(b.x_max, 7.5, 1e-8);
  EXPECT_NEAR(b.y_min, 0.5, 1e-8);
  EXPECT_NEAR(b.y_max, 1, 1e-8);
  const Bounds2D all = boundsOf(toFloorPlan(grid, false), {10, 0, M_PI / 2});
  EXPECT_NEAR(all.x_min, 7, 1e-12);
  EXPECT_NEAR(all.x_max, 8, 1e-12);
}

// Compares scene queries on a map with loops over all of its cells.

/// A map at a random pose, as a scene and cell by cell.
struct Case {
  OccupancyGrid grid;
  TPose2D world_from_map;
  bool on_lattice;  ///< cells of a power of two, not turned: all sums are exact

  explicit Case(Rng& rng) : on_lattice(rng.below(2) == 1) {
    const double sizes_m[] = {0.05, 0.1, 0.07};
    grid = randomGrid(rng, 4 + rng.below(24), 4 + rng.below(24), on_lattice ? 0.25 : sizes_m[rng.below(3)]);
    if (on_lattice) {
      grid.map_from_grid = {static_cast<double>(rng.below(9)) - 4, static_cast<double>(rng.below(9)) - 4, 0};
    } else {
      grid.map_from_grid = {rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
      world_from_map = {rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
    }
  }

  FloorPlan plan() const { return toFloorPlan(grid, false); }
  Bounds2D area() const { return boundsOf(plan(), world_from_map); }
  TPose2D worldFromGrid() const { return world_from_map + grid.map_from_grid; }
  Scene scene() const { return {solidsOf(plan(), world_from_map), 0, area()}; }

  /// All occupied cells, enlarged slightly.
  std::vector<Solid> cells(double margin_m) const {
    std::vector<Solid> solids;
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
      for (std::uint32_t column = 0; column < grid.columns; ++column) {
        if (grid.at(column, row) != Occupancy::occupied) continue;
        const TPose2D grid_from_cell((column + 0.5) * grid.cell_m, (row + 0.5) * grid.cell_m, 0);
        const double side_m = grid.cell_m + 2 * margin_m;
        solids.push_back({OrientedBox::from(worldFromGrid() + grid_from_cell, side_m, side_m), {0, 1}});
      }
    }
    return solids;
  }

  /// A random corner of cells, point on a cell border, or arbitrary point.
  TPoint2D place(Rng& rng) const {
    const auto along = [&](std::uint32_t count) {
      const double cell = static_cast<double>(rng.below(count + 3)) - 1;
      return (rng.below(3) > 0 ? cell : cell + rng.uniform()) * grid.cell_m;
    };
    const double x = along(grid.columns);
    return worldFromGrid().composePoint(TPoint2D(x, along(grid.rows)));
  }

  /// A random direction: along the cells, from corner to corner, or arbitrary.
  double direction(Rng& rng) const {
    const auto turns = rng.below(3);
    if (turns == 0) return rng.uniform(-M_PI, M_PI);
    const double quarters = static_cast<double>(rng.below(4));
    return worldFromGrid().phi + (quarters + (turns == 1 ? 0 : 0.5)) * M_PI / 2;
  }

  /// Exact where a lattice allows it.
  Ray ray(Rng& rng) const {
    const TPoint2D from = place(rng);
    Ray ray = Ray::towards({from.x, from.y, 0.5}, direction(rng));
    if (on_lattice && rng.below(2) == 1) {
      const double signs[] = {-1, 0, 1};
      ray.direction = {signs[rng.below(3)], signs[rng.below(3)], 0};
      if (ray.direction.norm() == 0) ray.direction.x = 1;
      ray.direction *= 1 / ray.direction.norm();
    }
    return ray;
  }
};

double nearest(const std::vector<Solid>& cells, const Ray& ray) {
  double nearest_m = kInfinity;
  for (const auto& cell : cells) nearest_m = std::min(nearest_m, intersect(ray, cell).value_or(kInfinity));
  return nearest_m;
}

double nearest(const std::vector<Solid>& cells, const Sector& sector) {
  double nearest_m = kInfinity;
  for (const auto& cell : cells) {
    nearest_m = std::min(nearest_m, nearestInSector(sector, cell).value_or(kInfinity));
  }
  return nearest_m;
}

constexpr double kSame_m = 1e-8;
constexpr double kHair_m = 3e-9;  ///< a little more than a seam

TEST(FloorPlanBruteForce, RaysHitTheCellsWithoutGaps) {
  std::size_t hits = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    const Case map(rng);
    const Scene scene = map.scene();
    const auto cells = map.cells(0), grown = map.cells(kHair_m);
    for (int i = 0; i < 100; ++i) {
      const Ray ray = map.ray(rng);
      const double got_m = scene.castRay(ray, 1e6).distance_m;
      // A ray never misses a cell in its way, even at a seam or a corner; and every hit is a cell.
      ASSERT_LE(got_m, nearest(cells, ray)) << "seed " << seed << " ray " << i;
      ASSERT_GE(got_m, nearest(grown, ray) - kSame_m) << "seed " << seed << " ray " << i;
      hits += got_m < kInfinity ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 10'000u);
}

TEST(FloorPlanBruteForce, RayBatchesHitTheCellsWithoutGaps) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    const Case map(rng);
    const Scene scene = map.scene();
    const auto cells = map.cells(0), grown = map.cells(kHair_m);
    const TPoint2D from = map.place(rng);
    std::vector<Ray> rays;
    for (int i = 0; i < 64; ++i) rays.push_back(Ray::towards({from.x, from.y, 0.5}, map.direction(rng)));
    const BeamFan fan(rays);
    BeamBatch batch;
    batch.place(fan, {}, 1e6);
    scene.cast(batch);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double got_m = batch.body(i) == BeamBatch::kNothing ? kInfinity : batch.distance(i);
      ASSERT_LE(got_m, nearest(cells, rays[i])) << "seed " << seed << " ray " << i;
      ASSERT_GE(got_m, nearest(grown, rays[i]) - kSame_m) << "seed " << seed << " ray " << i;
    }
  }
}

TEST(FloorPlanBruteForce, SectorsFindTheNearestCell) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    const Case map(rng);
    const Scene scene = map.scene();
    const auto cells = map.cells(0), grown = map.cells(kHair_m);
    for (int i = 0; i < 30; ++i) {
      const TPoint2D from = map.place(rng);
      const Sector sector = Sector::towards({from.x, from.y, 0.5}, map.direction(rng), rng.uniform(0.02, 1.2));
      const double got_m = senseSector(scene, sector, 1e6).distance_m;
      ASSERT_LE(got_m, nearest(cells, sector)) << "seed " << seed << " sector " << i;
      ASSERT_GE(got_m, nearest(grown, sector) - 1e-6) << "seed " << seed << " sector " << i;
    }
  }
}

TEST(FloorPlanBruteForce, ADiscStopsAtTheCells) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    const Case map(rng);
    const auto cells = map.cells(0);
    const auto solids = solidsOf(map.plan(), map.world_from_map);
    for (int i = 0; i < 20; ++i) {
      const TPoint2D from = map.place(rng);
      const double radius_m = rng.uniform(0.02, 0.4);
      const auto is_clear = [&](const Solid& solid) { return distance(solid.outline, from) > radius_m + 1e-4; };
      if (!std::all_of(cells.begin(), cells.end(), is_clear)) continue;
      const Path path{{from.x, from.y, map.direction(rng)}, rng.uniform(-2, 2), rng.uniform(-1, 1)};
      double slow = 1, fast = 1;
      for (const auto& cell : cells) slow = std::min(slow, firstContact(path, radius_m, cell.outline));
      for (const auto& solid : solids) fast = std::min(fast, firstContact(path, radius_m, solid.outline));
      // At a grazing angle a nanometre affects a longer part of the path, but never lets the disc in.
      ASSERT_LE(fast * std::abs(path.length_m), slow * std::abs(path.length_m) + kSame_m) << "seed " << seed;
      ASSERT_GE(fast * std::abs(path.length_m), slow * std::abs(path.length_m) - 1e-3) << "seed " << seed;
    }
  }
}

TEST(FloorPlan, DoesNotBlockRaysAboveItsWalls) {
  const FloorPlan plan = toFloorPlan(gridOf({"#"}), false);
  const Scene scene(solidsOf(plan, {}, {0, 0.8}), 0, {-1, 1, -1, 1});
  EXPECT_TRUE(scene.castRay(Ray::towards({-1, 0.25, 0.8}, 0), 5));
  EXPECT_FALSE(scene.castRay(Ray::towards({-1, 0.25, 0.81}, 0), 5));
}

TEST(FloorPlan, NeighbouringCellsOverlapAnywhere) {
  Rng rng(1, RandomPurpose::test);
  for (int i = 0; i < 2000; ++i) {
    OccupancyGrid grid = gridOf({"#", "#"});
    grid.map_from_grid = {rng.uniform(-1e7, 1e7), rng.uniform(-1e7, 1e7), rng.uniform(-M_PI, M_PI)};
    FloorPlan plan = toFloorPlan(grid, false);
    plan.occupied = {{0, 0, 1, 1}, {0, 1, 1, 1}};
    const auto solids = solidsOf(plan, {});
    EXPECT_TRUE(overlap(solids[0], solids[1])) << grid.map_from_grid;
  }
}

TEST(FloorPlan, HasNoGapsFarFromTheOrigin) {
  // At coordinates used in surveying, a nanometre is below the resolution of doubles.
  OccupancyGrid grid = gridOf({"#", "#", "#", "#"});
  grid.map_from_grid = {4'451'000.3, 5'438'000.7, 0.3};
  FloorPlan plan = toFloorPlan(grid, false);
  plan.occupied = {{0, 0, 1, 1}, {0, 1, 1, 1}, {0, 2, 1, 1}, {0, 3, 1, 1}};  // all seams
  const Scene scene(solidsOf(plan, {}), 0, boundsOf(plan, {}));
  for (int seam = 1; seam <= 3; ++seam) {
    const TPoint2D from = grid.map_from_grid.composePoint(TPoint2D(-1, 0.5 * seam));
    for (int i = -50; i <= 50; ++i) {
      EXPECT_TRUE(scene.castRay(Ray::towards({from.x, from.y, 0.5}, 0.3 + i * 1e-9), 5)) << seam << " " << i;
    }
  }
}

}  // namespace
}  // namespace robosim
