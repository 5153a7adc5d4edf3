#include "maze/grid.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Grid, NumbersCellsFromTheOriginInBothDirections) {
  const Grid<int> grid(0.5);
  EXPECT_EQ(grid.cellAt({0.1, 0.1}), (Cell{0, 0}));
  EXPECT_EQ(grid.cellAt({-0.1, 0.6}), (Cell{-1, 1}));
  EXPECT_EQ(grid.center({-1, 1}).x, -0.25);
  EXPECT_EQ(grid.center({-1, 1}).y, 0.75);
}

TEST(Grid, HasNoCellsBeforeTheFirstCover) {
  Grid<int> grid(1);
  EXPECT_FALSE(grid.contains({0, 0}));
  grid.cover({-3, -2}, {4, 5});
  EXPECT_TRUE(grid.contains({-3, 5}));
  EXPECT_FALSE(grid.contains({-4, 0}));
  EXPECT_EQ(grid.size(), 64u);
  EXPECT_EQ((grid[{4, 5}]), 0);
}

TEST(Grid, KeepsItsValuesWhenItGrows) {
  Grid<int> grid(1);
  grid.cover({0, 0}, {9, 9});
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) grid[{x, y}] = 100 * x + y;
  }
  grid.cover({-5, 3}, {2, 30});
  grid.cover({0, -40}, {60, 0});
  EXPECT_TRUE(grid.contains({-5, -40}));
  EXPECT_TRUE(grid.contains({60, 30}));
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) EXPECT_EQ((grid[{x, y}]), 100 * x + y);
  }
  EXPECT_EQ((grid[{-1, 3}]), 0);
}

TEST(Grid, GrowsGeometrically) {
  Grid<int> grid(1);
  grid.cover({0, 0}, {9, 9});
  grid.cover({0, 0}, {10, 9});
  const std::size_t size = grid.size();
  grid.cover({0, 0}, {30, 9});
  EXPECT_EQ(grid.size(), size);
}

TEST(Grid, GrowsUpToItsMaximumSide) {
  Grid<int> grid(1);
  grid.cover({0, 0}, {9, 9});
  for (int i = 0; i < 2000; ++i) grid.cover({i, 0}, {i + 9, 9});
  EXPECT_EQ(grid.columns(), Grid<int>::kMaxSide);
  EXPECT_TRUE(grid.contains({0, 0}));
  EXPECT_FALSE(grid.contains({2000, 0}));
}

TEST(Grid, FindsTheCellOfAnIndex) {
  Grid<int> grid(1);
  grid.cover({-3, -7}, {4, 2});
  for (std::size_t i = 0; i < grid.size(); ++i) EXPECT_EQ(grid.index(grid.cell(i)), i);
}

TEST(Grid, ResetKeepsTheCellsAndClearsTheirValues) {
  Grid<int> grid(1);
  grid.cover({0, 0}, {9, 9});
  grid[{1, 1}] = 5;
  grid.reset();
  EXPECT_EQ((grid[{1, 1}]), 0);
  EXPECT_EQ(grid.size(), 100u);
}

TEST(Grid, ResetOfAFullGridAllowsAnotherArea) {
  Grid<int> grid(1);
  for (int i = 0; i < 1000; ++i) grid.cover({i, 0}, {i, 0});
  EXPECT_FALSE(grid.contains({999, 0}));
  grid.reset();
  grid.cover({999, 0}, {999, 0});
  EXPECT_TRUE(grid.contains({999, 0}));
  EXPECT_FALSE(grid.contains({0, 0}));
}

}  // namespace
}  // namespace robosim
