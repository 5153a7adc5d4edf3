#include <algorithm>
#include <cstdint>
#include <string>

#include "base/random.h"
#include "world/generation/bounds_check.h"
#include "world/generation/generators.h"

namespace robosim {
namespace {

/// Cells with or without walls towards their right and upper neighbours.
class Maze {
 public:
  Maze(int columns, int rows) : columns_(columns), rows_(rows), walls_(2 * std::size_t{count()}, 1) {}

  std::uint32_t count() const { return static_cast<std::uint32_t>(columns_ * rows_); }
  int column(std::uint32_t cell) const { return static_cast<int>(cell) % columns_; }
  int row(std::uint32_t cell) const { return static_cast<int>(cell) / columns_; }

  /// Neighbours in the plan, with or without a wall between.
  std::vector<std::uint32_t> around(std::uint32_t cell) const {
    std::vector<std::uint32_t> cells;
    if (column(cell) + 1 < columns_) cells.push_back(cell + 1);
    if (row(cell) + 1 < rows_) cells.push_back(cell + static_cast<std::uint32_t>(columns_));
    if (column(cell) > 0) cells.push_back(cell - 1);
    if (row(cell) > 0) cells.push_back(cell - static_cast<std::uint32_t>(columns_));
    return cells;
  }
  bool isOpen(std::uint32_t a, std::uint32_t b) const { return walls_[between(a, b)] == 0; }
  void open(std::uint32_t a, std::uint32_t b) { walls_[between(a, b)] = 0; }
  std::vector<std::uint32_t> openAround(std::uint32_t cell) const {
    std::vector<std::uint32_t> cells = around(cell);
    std::erase_if(cells, [&](std::uint32_t near) { return !isOpen(cell, near); });
    return cells;
  }
  bool hasWallRight(int column, int row) const {
    return column < 0 || column + 1 >= columns_ || walls_[2 * index(column, row)] != 0;
  }
  bool hasWallAbove(int column, int row) const {
    return row < 0 || row + 1 >= rows_ || walls_[2 * index(column, row) + 1] != 0;
  }

 private:
  std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * columns_ + column); }
  /// Index of the wall between two neighbours.
  std::size_t between(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t low = std::min(a, b);
    return 2 * std::size_t{low} + (row(a) == row(b) ? 0 : 1);
  }

  int columns_, rows_;
  std::vector<std::uint8_t> walls_;  ///< of each cell, to the right and above; 0: open
};

/// Randomised depth-first search: connects all cells by a tree.
void carve(Maze& maze, Rng& rng) {
  std::vector<std::uint8_t> seen(maze.count(), 0);
  std::vector<std::uint32_t> way{rng.below(maze.count())};
  seen[way.back()] = 1;
  while (!way.empty()) {
    auto fresh = maze.around(way.back());
    std::erase_if(fresh, [&](std::uint32_t cell) { return seen[cell] != 0; });
    if (fresh.empty()) {
      way.pop_back();
      continue;
    }
    const std::uint32_t cell = fresh[rng.below(static_cast<std::uint32_t>(fresh.size()))];
    maze.open(way.back(), cell);
    seen[cell] = 1;
    way.push_back(cell);
  }
}

void openDeadEnds(Maze& maze, double braid, Rng& rng) {
  for (std::uint32_t cell = 0; cell < maze.count(); ++cell) {
    if (maze.openAround(cell).size() != 1) continue;
    const bool opens = rng.uniform() < braid;
    auto closed = maze.around(cell);
    std::erase_if(closed, [&](std::uint32_t near) { return maze.isOpen(cell, near); });
    if (opens && !closed.empty()) maze.open(cell, closed[rng.below(static_cast<std::uint32_t>(closed.size()))]);
  }
}

/// Calls add(first, last) for every run of numbers below `count` that stand.
template <typename Stands, typename Add>
void forRuns(int count, const Stands& stands, const Add& add) {
  for (int i = 0; i < count; ++i) {
    if (!stands(i)) continue;
    const int first = i;
    while (i + 1 < count && stands(i + 1)) ++i;
    add(first, i);
  }
}

/// One box for every straight run of wall.
void addWalls(const Maze& maze, const MazeOptions& o, std::vector<WorldObject>& objects) {
  const auto x = [&](double column) { return (column - (o.columns - 1) / 2.0) * o.cell_m; };
  const auto y = [&](double row) { return (row - (o.rows - 1) / 2.0) * o.cell_m; };
  const auto add = [&](double from_column, double to_column, double from_row, double to_row) {
    objects.push_back(wall("Wall" + std::to_string(objects.size() + 1), x((from_column + to_column) / 2),
                           y((from_row + to_row) / 2), (to_column - from_column) * o.cell_m + kWallThickness_m,
                           (to_row - from_row) * o.cell_m + kWallThickness_m));
  };
  for (int row = -1; row < o.rows; ++row) {
    forRuns(
        o.columns, [&](int column) { return maze.hasWallAbove(column, row); },
        [&](int first, int last) { add(first - 0.5, last + 0.5, row + 0.5, row + 0.5); });
  }
  for (int column = -1; column < o.columns; ++column) {
    forRuns(
        o.rows, [&](int row) { return maze.hasWallRight(column, row); },
        [&](int first, int last) { add(column + 0.5, column + 0.5, first - 0.5, last + 0.5); });
  }
}

}  // namespace

Scenery generateMaze(const MazeOptions& o, std::uint64_t seed) {
  requireWithin("columns", o.columns, 2, 1000);
  requireWithin("rows", o.rows, 2, 1000);
  requireWithin("braid", o.braid, 0, 1);
  requireWithin("cell", o.cell_m, 1, 100);
  Rng rng(seed, RandomPurpose::scenery);
  Maze maze(o.columns, o.rows);
  carve(maze, rng);
  openDeadEnds(maze, o.braid, rng);
  Scenery scenery;
  const double x_m = (o.columns * o.cell_m + kWallThickness_m) / 2, y_m = (o.rows * o.cell_m + kWallThickness_m) / 2;
  scenery.bounds = {-x_m, x_m, -y_m, y_m};
  addWalls(maze, o, scenery.objects);
  for (std::uint32_t cell = 0; cell < maze.count(); ++cell) {
    scenery.places.at.emplace_back((maze.column(cell) - (o.columns - 1) / 2.0) * o.cell_m,
                                   (maze.row(cell) - (o.rows - 1) / 2.0) * o.cell_m);
    scenery.places.next.push_back(maze.openAround(cell));
  }
  return scenery;
}

}  // namespace robosim
