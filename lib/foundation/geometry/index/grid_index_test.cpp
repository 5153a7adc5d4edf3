#include "geometry/index/grid_index.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "geometry/testing/random_scene.h"

namespace robosim {
namespace {

std::vector<std::uint32_t> listed(const GridIndex& grid, int column, int row) {
  std::vector<std::uint32_t> numbers;
  grid.visitCell(column, row, [&](std::uint32_t i) { numbers.push_back(grid.numberOf(i)); });
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// Area represented by a cell: its square, extended outwards at the border.
Outline partOf(const GridIndex& grid, int column, int row) {
  constexpr double kFar_m = 1000;
  const double size = grid.cellSize();
  const double left = column == 0 ? -kFar_m : grid.low().x + column * size;
  const double right = column == grid.columns() - 1 ? kFar_m : grid.low().x + (column + 1) * size;
  const double low = row == 0 ? -kFar_m : grid.low().y + row * size;
  const double high = row == grid.rows() - 1 ? kFar_m : grid.low().y + (row + 1) * size;
  return rectangle({left, right, low, high});
}

TEST(GridIndex, CoversItsAreaWithWholeCells) {
  const GridIndex grid({-1, 4, 2, 4.5}, 2);
  EXPECT_EQ(grid.columns(), 3);
  EXPECT_EQ(grid.rows(), 2);
  EXPECT_EQ(grid.cellSize(), 2);
  EXPECT_EQ(grid.low().x, -1);
  EXPECT_EQ(grid.low().y, 2);
  const GridIndex fitting({0, 6, 0, 4}, 2);
  EXPECT_EQ(fitting.columns(), 3);
  EXPECT_EQ(fitting.rows(), 2);
  const GridIndex tiny({0, 0.1, 0, 0.1}, 2);
  EXPECT_EQ(tiny.columns(), 1);
  EXPECT_EQ(tiny.rows(), 1);
}

TEST(GridIndex, ClampsCoordinatesToItsCells) {
  const GridIndex grid({-1, 5, 2, 6}, 2);
  EXPECT_EQ(grid.column(-1), 0);
  EXPECT_EQ(grid.column(0.99), 0);
  EXPECT_EQ(grid.column(1), 1) << "a border belongs to the cell on its right";
  EXPECT_EQ(grid.column(4.99), 2);
  EXPECT_EQ(grid.row(3.99), 0);
  EXPECT_EQ(grid.row(4), 1);
  for (double far : {5.0, 100.0, 1e9, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(grid.column(far), 2) << far;
    EXPECT_EQ(grid.row(far + 2), 1) << far;
    EXPECT_EQ(grid.column(-far), 0) << far;
    EXPECT_EQ(grid.row(-far), 0) << far;
  }
}

TEST(GridIndex, ListsASolidInTheCellsItOverlaps) {
  GridIndex grid({0, 8, 0, 8}, 2);
  // 0 within one cell; 1 over the border between two; 2 beyond the upper right corner.
  grid.build(std::vector<Solid>{
      {Circle{{1, 1}, 0.5}, {0, 1}}, {OrientedBox{{2, 1}, {1, 0}, 0.5, 0.25}, {0, 1}}, {Circle{{50, 50}, 1}, {0, 1}}});
  EXPECT_EQ(listed(grid, 0, 0), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(listed(grid, 1, 0), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(listed(grid, 3, 3), (std::vector<std::uint32_t>{2}));
  EXPECT_TRUE(listed(grid, 1, 1).empty());
}

TEST(GridIndex, SortsSolidsByCellAndFindsThemByNumber) {
  GridIndex grid({0, 4, 0, 4}, 2);
  // Cells from the lower left, row by row: number 1, then 3, then 0 and 2.
  grid.build(std::vector<Solid>{{Circle{{3, 3}, 0.1}, {0, 1}},
                                {Circle{{1, 1}, 0.2}, {0, 1}},
                                {Circle{{3, 3.5}, 0.3}, {0, 1}},
                                {Circle{{3, 1}, 0.4}, {0, 1}}});
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < grid.items().size(); ++i) numbers.push_back(grid.numberOf(i));
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{1, 3, 0, 2}));
  for (std::uint32_t number = 0; number < 4; ++number) {
    EXPECT_EQ(grid.numberOf(grid.indexOf(number)), number);
    EXPECT_DOUBLE_EQ(grid.items()[grid.indexOf(number)].half_length_m, 0.1 * (number + 1));
  }
}

TEST(GridIndex, ListsADiagonalWallOnlyInTheCellsItCrosses) {
  GridIndex grid({0, 100, 0, 100}, 1);
  grid.build(std::vector<Solid>{{OrientedBox::from({50, 50, 0.7}, 130, 0.1), {0, 1}}});
  int cells = 0;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) cells += !listed(grid, column, row).empty();
  }
  // It crosses about 100 columns and 84 rows: one cell per border crossed, not the 8,400 of its bounds.
  EXPECT_GT(cells, 150);
  EXPECT_LT(cells, 400);
}

TEST(GridIndex, ListsEverySolidInAllCellsItOverlapsAndNoneBeyondItsBounds) {
  Rng rng(1);
  const SolidSpread families[] = {
      {},
      {.lattice_m = 0.25},
      {.area = {-30, 30, -30, 30}, .size_max_m = 20},
      {.area = {-40, 40, -40, 40}, .size_min_m = 0.01, .size_max_m = 200},
  };
  for (int scene = 0; scene < 400; ++scene) {
    const double cell = scene % 3 ? rng.uniform(0.5, 5) : 1;
    GridIndex grid({-8, 8, -4, 6}, cell);
    // Rebuilt repeatedly, for fewer and for more solids.
    for (const std::size_t count : {20u, 3u, 30u}) {
      const auto solids = randomSolids(rng, count, families[scene % 4]);
      grid.build(solids);
      for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
          const auto found = listed(grid, column, row);
          ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << "each once";
          const Outline part = partOf(grid, column, row);
          for (std::uint32_t i = 0; i < solids.size(); ++i) {
            const bool is_listed = std::binary_search(found.begin(), found.end(), i);
            if (is_listed) {
              ASSERT_LT(distance(rectangle(boundsOf(solids[i].outline)), part), 1e-5)
                  << "solid " << i << " of scene " << scene;
            } else {
              ASSERT_FALSE(overlap(solids[i], {part, {-9, 9}})) << "solid " << i << " of scene " << scene;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace robosim
