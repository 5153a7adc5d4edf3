#include "maze/wavefront.h"

#include <map>

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim {
namespace {

/// Cells that the robot cannot enter, as text: '#' blocked, ',' close to a wall.
MazeMap mapOf(const std::vector<std::string>& rows) {
  MazeMap map(1);
  map.cover({0, 0}, {static_cast<int>(rows[0].size()) - 1, static_cast<int>(rows.size()) - 1});
  for (int y = 0; y < static_cast<int>(rows.size()); ++y) {
    for (int x = 0; x < static_cast<int>(rows[0].size()); ++x) {
      const char c = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      map[{x, y}].walls_near = c == '#';
      map[{x, y}].evidence = c == '#' ? 12 : 0;
      map[{x, y}].walls_close = c != '.';
    }
  }
  return map;
}

auto only(const Cell& goal) {
  return [goal](const Cell& cell) { return cell == goal ? 0 : -1; };
}

std::vector<Cell> pathBetween(const MazeMap& map, const Cell& start, const Cell& goal) {
  Wavefront wavefront;
  std::vector<Cell> path;
  if (wavefront.findGoal(map, start, 100000, only(goal))) wavefront.pathTo(map, goal, path);
  return path;
}

TEST(Wavefront, FindsAStraightPathThroughFreeSpace) {
  EXPECT_EQ(pathBetween(mapOf({".....", ".....", "....."}), {0, 1}, {3, 1}),
            (std::vector<Cell>{{1, 1}, {2, 1}, {3, 1}}));
  EXPECT_EQ(pathBetween(mapOf({".....", ".....", "....."}), {0, 0}, {2, 2}), (std::vector<Cell>{{1, 1}, {2, 2}}));
}

TEST(Wavefront, FindsAPathAroundAWall) {
  const auto path = pathBetween(mapOf({".......",  //
                                       "...#...",  //
                                       "...#...",  //
                                       "...#...",  //
                                       "...#..."}),
                                {2, 4}, {4, 4});
  ASSERT_EQ(path.size(), 8u);
  EXPECT_EQ(path[3], (Cell{3, 0}));
}

TEST(Wavefront, FindsNoPathThroughAClosedWall) {
  EXPECT_TRUE(pathBetween(mapOf({"....#...", "....#...", "....#..."}), {0, 1}, {7, 1}).empty());
}

TEST(Wavefront, TakesADetourToKeepItsClearance) {
  const auto path = pathBetween(mapOf({".........",  //
                                       ".........",  //
                                       "..,,,,,..",  //
                                       "..,,,,,.."}),
                                {0, 2}, {8, 2});
  for (const Cell& cell : path) EXPECT_TRUE(cell.y <= 1 || cell.x < 2 || cell.x > 6);
}

TEST(Wavefront, FindsAPathOutOfBlockedCellsAroundTheStart) {
  // The start and its surroundings are blocked, but not occupied.
  MazeMap map = mapOf({"........", "........", "........"});
  for (int y = 0; y < 3; ++y) {
    map[{0, y}].evidence = 12;
    for (int x = 0; x < 3; ++x) map[{x, y}].walls_near = 1;
  }
  EXPECT_EQ(pathBetween(map, {1, 1}, {4, 1}), (std::vector<Cell>{{2, 1}, {3, 1}, {4, 1}}));
  EXPECT_TRUE(pathBetween(map, {7, 1}, {1, 1}).empty());  // no path leads back into it
}

TEST(Wavefront, SelectsTheGoalOfLeastTotalCost) {
  const MazeMap map = mapOf({"..........", "..........", ".........."});
  Wavefront wavefront;
  const auto judge = [](const Cell& cell) {
    if (cell == Cell{3, 1}) return 20;  // at a cost of 6
    if (cell == Cell{8, 1}) return 3;   // at a cost of 16
    return -1;
  };
  EXPECT_EQ(wavefront.findGoal(map, {0, 1}, 1000, judge), (Cell{8, 1}));
  EXPECT_EQ(wavefront.findGoal(map, {0, 1}, 19, judge), std::nullopt);
}

TEST(Wavefront, FindsTheSameCostsAsBellmanFord) {
  Rng rng(11);
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<std::string> rows(15, std::string(18, '.'));
    for (auto& row : rows) {
      for (char& c : row) {
        const auto dice = rng.below(10);
        c = dice < 3 ? '#' : dice < 5 ? ',' : '.';
      }
    }
    const Cell start{static_cast<int>(rng.below(18)), static_cast<int>(rng.below(15))};
    rows[static_cast<std::size_t>(start.y)][static_cast<std::size_t>(start.x)] = '.';
    const MazeMap map = mapOf(rows);

    // Bellman–Ford: relaxes every edge until no cost changes.
    std::vector<int> cost(map.size(), 1000000);
    cost[map.index(start)] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < map.size(); ++i) {
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const Cell to{map.cell(i).x + dx, map.cell(i).y + dy};
            if ((dx == 0 && dy == 0) || !map.contains(to) || map[to].blocked()) continue;
            const int step = (dx != 0 && dy != 0 ? 3 : 2) + (map[to].walls_close > 0 ? 3 : 0);
            if (cost[i] + step >= cost[map.index(to)]) continue;
            cost[map.index(to)] = cost[i] + step;
            changed = true;
          }
        }
      }
    }

    Wavefront wavefront;
    for (std::size_t i = 0; i < map.size(); ++i) {
      if (map.cell(i) == start) continue;
      const auto found = wavefront.findGoal(map, start, 100000, only(map.cell(i)));
      ASSERT_EQ(found.has_value(), cost[i] < 1000000);
      // A lower limit of the cost must not suffice.
      if (found) {
        ASSERT_FALSE(wavefront.findGoal(map, start, cost[i], only(map.cell(i))));
        ASSERT_TRUE(wavefront.findGoal(map, start, cost[i] + 1, only(map.cell(i))));
      }
    }
  }
}

TEST(Wavefront, SearchesAMapThatHasGrown) {
  MazeMap map = mapOf({"...", "...", "..."});
  Wavefront wavefront;
  EXPECT_TRUE(wavefront.findGoal(map, {0, 0}, 1000, only({2, 2})));
  map.cover({-30, 0}, {2, 2});
  std::vector<Cell> path;
  ASSERT_TRUE(wavefront.findGoal(map, {0, 0}, 1000, only({-20, 0})));
  wavefront.pathTo(map, {-20, 0}, path);
  EXPECT_EQ(path.size(), 20u);
  EXPECT_FALSE(wavefront.findGoal(map, {500, 0}, 1000, only({-20, 0})));  // there is no path from outside the map
}

}  // namespace
}  // namespace robosim
