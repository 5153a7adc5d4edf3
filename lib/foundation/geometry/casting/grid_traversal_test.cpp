#include "geometry/casting/grid_traversal.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/testing/random_scene.h"

namespace robosim {
namespace {

constexpr Bounds2D kArea{-3, 5, 2, 8};

/// Cells that a ray visits within a reach, numbered row by row.
std::vector<std::ptrdiff_t> visitedCells(const GridIndex& grid, const Ray& ray, double reach_m) {
  const DoublePair in = inCells(grid, DoublePair{ray.origin.x, ray.origin.y});
  EXPECT_TRUE(contains(grid, in));
  GridTraversal traversal(grid, in, DoublePair{ray.direction.x, ray.direction.y});
  traversal.setReach(reach_m);
  std::vector<std::ptrdiff_t> cells;
  do {
    cells.push_back(traversal.pack() - grid.packs().data());
  } while (traversal.advance());
  return cells;
}

TEST(GridTraversal, VisitsTheCellsInOrder) {
  const GridIndex grid({0, 4, 0, 3}, 1);  // cells 0 to 3 in the lowest row, then 4 to 7 and 8 to 11
  const double s = std::sqrt(0.5);
  using Cells = std::vector<std::ptrdiff_t>;
  EXPECT_EQ(visitedCells(grid, {{0.5, 0.5, 0}, {1, 0, 0}}, 2), (Cells{0, 1, 2}));
  EXPECT_EQ(visitedCells(grid, {{3.5, 0.5, 0}, {0, 1, 0}}, 100), (Cells{3, 7, 11})) << "to the border of the grid";
  EXPECT_EQ(visitedCells(grid, {{3.5, 2.5, 0}, {-1, 0, 0}}, 100), (Cells{11, 10, 9, 8}));
  EXPECT_EQ(visitedCells(grid, {{0.75, 0.5, 0}, {s, s, 0}}, 100), (Cells{0, 1, 5, 6, 10, 11}));
  EXPECT_EQ(visitedCells(grid, {{2.5, 1.5, 0}, {1, 0, 0}}, 0.5), (Cells{6})) << "up to the border";
  EXPECT_EQ(visitedCells(grid, {{2.5, 1.5, 0}, {1, 0, 0}}, 0), (Cells{6}));
  EXPECT_EQ(visitedCells(grid, {{2, 1.5, 0}, {-0.0, -1, 0}}, 9), (Cells{6, 2})) << "along a border";
  EXPECT_EQ(visitedCells(grid, {{0, 0, 0}, {-0.0, -1, 0}}, 9), (Cells{0})) << "out at a corner";
}

TEST(GridTraversal, ReportsWhetherTheRayLeavesTheGrid) {
  const GridIndex grid({0, 4, 0, 3}, 1);
  const GridTraversal traversal(grid, inCells(grid, DoublePair{1, 1}), DoublePair{1, 0});
  EXPECT_FALSE(traversal.leavesWithin(2.99));
  EXPECT_TRUE(traversal.leavesWithin(3));
}

TEST(GridTraversal, VisitsEveryCellOfTheRayThroughNeighbours) {
  Rng rng(1);
  for (int i = 0; i < 3000; ++i) {
    const GridIndex grid(kArea, rng.uniform(0.1, 3));
    const Ray ray = randomPlanarRay(rng, kArea, 0, 0);
    const double reach_m = rng.uniform(0, 12);
    const auto cells = visitedCells(grid, ray, reach_m);
    std::size_t at = 0;
    constexpr int kSteps = 500;
    for (int step = 0; step < kSteps; ++step) {
      const auto place = ray.at(reach_m * step / kSteps);
      if (!contains(grid, inCells(grid, DoublePair{place.x, place.y}))) break;
      const auto cell = grid.row(place.y) * grid.columns() + grid.column(place.x);
      while (at < cells.size() && cells[at] != cell) ++at;
      ASSERT_LT(at, cells.size()) << "ray " << i << " misses a cell";
    }
    for (std::size_t k = 1; k < cells.size(); ++k) {
      const auto step = std::abs(cells[k] - cells[k - 1]);
      ASSERT_TRUE(step == 1 || step == grid.columns()) << "ray " << i;
      ASSERT_GE(cells[k], 0);
      ASSERT_LT(cells[k], std::ptrdiff_t{grid.columns()} * grid.rows());
    }
  }
}

TEST(GridTraversal, EndsInsideTheGridForAnyDirectionAndReach) {
  const GridIndex grid(kArea, 1);
  const double infinity = std::numeric_limits<double>::infinity();
  const double numbers[] = {0, -0.0, 5e-324, -5e-324, 1e-310,   -1e-300,     1e-15,
                            1, -1,   1e15,   -1e300,  infinity, std::nan("")};
  for (const double dx : numbers) {
    for (const double dy : numbers) {
      for (const double reach_m : {0.0, 1e300, infinity, std::nan("")}) {
        for (const double x : {-3.0, 1.0, 1.5, std::nextafter(5.0, 0.0)}) {
          for (const auto cell : visitedCells(grid, {{x, 5, 0}, {dx, dy, 0}}, reach_m)) {
            ASSERT_GE(cell, 0) << dx << ' ' << dy << ' ' << reach_m << ' ' << x;
            ASSERT_LT(cell, std::ptrdiff_t{grid.columns()} * grid.rows())
                << dx << ' ' << dy << ' ' << reach_m << ' ' << x;
          }
        }
      }
    }
  }
}

TEST(GridTraversal, StaysOnTheLargestGrid) {
  const GridIndex grid({0, 32768, 0, 2}, 1);
  ASSERT_EQ(grid.columns(), 32768);
  EXPECT_EQ(visitedCells(grid, {{0.5, 0.5, 0}, {1, 0, 0}}, 1e300).size(), 32768U);
  const double slope = 1.0 / 32768;
  const double x = 1 / std::hypot(1, slope);
  EXPECT_EQ(visitedCells(grid, {{0.5, 0.5, 0}, {x, slope * x, 0}}, 1e300).size(), 32769U) << "one row up in between";
}

}  // namespace
}  // namespace robosim
