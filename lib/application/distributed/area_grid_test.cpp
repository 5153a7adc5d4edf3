#include "distributed/area_grid.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

bool contains(const Area& area, std::uint32_t cell) {
  return std::any_of(area.begin(), area.end(),
                     [&](const CellRange& range) { return cell >= range.begin && cell < range.end; });
}

TEST(AreaGrid, ListsTheCellsWithinReachByRows) {
  // Cells of 2 m: 6 columns and rows, since the surface's upper edges are in cells of their own.
  const AreaGrid grid({0, 10, 0, 10}, 2, 4);
  EXPECT_EQ(grid.cells(), 36u);
  EXPECT_EQ(grid.cellAt({0, 0, 0}), 0u);
  EXPECT_EQ(grid.cellAt({5, 3, 0}), 8u);
  EXPECT_EQ(grid.cellAt({-7, 300, 0}), 30u) << "beyond the surface";
  // From (1, 1) to (9, 9), and from (-3, -3) to (1, 1).
  const std::vector<TPose2D> poses{{5, 5, 0}, {-1, -1, 0}};
  EXPECT_EQ(grid.around(poses, {1, 2}, 2), (Area{{0, 1}}));
  EXPECT_EQ(grid.around(poses, {0, 1}, 4), (Area{{0, 5}, {6, 11}, {12, 17}, {18, 23}, {24, 29}}));
  EXPECT_EQ(grid.around(poses, {1, 1}, 4), Area());
}

TEST(AreaGrid, ContainsAllPointsWithinReachAndNoneTwoCellsBeyond) {
  Rng rng(1);
  for (int round = 0; round < 300; ++round) {
    const double width_m = rng.uniform(0.1, 300), length_m = rng.uniform(0.1, 300), reach_m = rng.uniform(4, 40);
    const AreaGrid grid({-width_m, width_m, 5, 5 + length_m}, 10, reach_m);
    const auto somewhere = [&] { return TPose2D(rng.uniform(-1.1, 1.1) * width_m, rng.uniform(0, 1.1) * length_m, 0); };
    std::vector<TPose2D> poses;
    for (int i = 0; i < 10; ++i) poses.push_back(somewhere());
    const Area area = grid.around(poses, {2, 7}, reach_m);
    std::string bytes;
    writeArea(area, bytes);
    EXPECT_EQ(readArea(bytes, grid.cells()), area);
    for (int i = 0; i < 100; ++i) {
      const TPose2D at = somewhere();
      bool is_near = false, is_far = true;
      for (std::size_t k = 2; k < 7; ++k) {
        const auto off_m = [&](double x, double y) { return std::max(std::abs(at.x - x), std::abs(at.y - y)); };
        is_near = is_near || off_m(poses[k].x, poses[k].y) <= reach_m;
        // A cell is half the reach wide. A robot beyond the surface is in a cell at its edge.
        const double x = std::clamp(poses[k].x, -width_m, width_m), y = std::clamp(poses[k].y, 5.0, 5 + length_m);
        is_far = is_far && off_m(x, y) > 2 * reach_m;
      }
      const bool is_inside = std::abs(at.x) <= width_m && at.y >= 5 && at.y <= 5 + length_m;
      const bool is_contained = contains(area, grid.cellAt(at));
      EXPECT_FALSE(is_near && !is_contained) << round;
      EXPECT_FALSE(is_far && is_inside && is_contained) << round;
    }
  }
}

TEST(AreaGrid, HasNotManyMoreCellsThan65536OrFourTimesTheRobots) {
  for (const Bounds2D& surface : {Bounds2D{0, 1e6, 0, 1e6}, Bounds2D{0, 1e6, 0, 0.5}, Bounds2D{0, 0, 0, 1e6}}) {
    for (const std::uint32_t robots : {1u, 100'000u}) {
      const std::uint32_t expected = std::max(65536u, 4 * robots);
      const AreaGrid grid(surface, robots, 1);
      EXPECT_LE(grid.cells(), 3 * expected + 1);
      EXPECT_GE(grid.cells(), expected);
    }
  }
}

TEST(AreaGrid, HasCellsOfHalfTheReachInWorldsOfMillionsOfRobots) {
  // 16 m² per robot, as in the benchmark of ranks, and cells of 4.05 m.
  constexpr double kReach_m = 8.1;
  for (const std::size_t rows : {1'000u, 3'162u}) {
    const double side_m = 4 * static_cast<double>(rows);
    const AreaGrid grid({0, side_m, 0, side_m}, rows * rows, kReach_m);
    const auto cells_per_side = static_cast<std::uint32_t>(side_m / 4.05) + 1;
    EXPECT_EQ(grid.cells(), cells_per_side * cells_per_side);
  }
}

TEST(AreaGrid, RejectsBytesThatAreNoArea) {
  const auto bytes_of = [](const Area& area) {
    std::string bytes;
    writeArea(area, bytes);
    return bytes;
  };
  EXPECT_EQ(readArea("", 10), Area());
  for (const Area& area : {Area{{3, 3}}, Area{{3, 11}}, Area{{3, 5}, {4, 6}}, Area{{3, 5}, {1, 2}}}) {
    EXPECT_THROW(readArea(bytes_of(area), 10), std::runtime_error);
  }
  EXPECT_THROW(readArea(bytes_of({{3, 5}}).substr(1), 10), std::runtime_error);
}

TEST(RobotsByCell, FindsThoseInTheCellsOfAnArea) {
  Rng rng(1);
  const AreaGrid grid({0, 50, 0, 50}, 500, 10);
  RobotsByCell by_cell(grid);
  std::vector<TPose2D> poses;
  for (int i = 0; i < 500; ++i) poses.emplace_back(rng.uniform(0, 50), rng.uniform(0, 50), 0);
  for (const RobotRange robots : {RobotRange{0, 500}, RobotRange{100, 130}, RobotRange{7, 7}}) {
    by_cell.assign(poses, robots);
    const Area area{{0, 1}, {20, 60}, {61, 70}, {grid.cells() - 1, grid.cells()}};
    std::vector<std::uint32_t> found, expected;
    by_cell.addWithin(area, found);
    std::sort(found.begin(), found.end());
    for (std::size_t i = robots.begin; i < robots.end; ++i) {
      if (contains(area, grid.cellAt(poses[i]))) expected.push_back(static_cast<std::uint32_t>(i));
    }
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace robosim
