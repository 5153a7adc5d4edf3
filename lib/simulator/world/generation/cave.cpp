#include <cstdint>

#include "base/random.h"
#include "world/generation/bounds_check.h"
#include "world/generation/generators.h"

namespace robosim {
namespace {

constexpr double kCell_m = 0.5;
constexpr int kRounds = 5;
constexpr int kRockAround = 5;  // of nine cells

/// Cells of rock or air; everything outside, and the rim, is rock.
class Cave {
 public:
  Cave(int columns, int rows) : columns_(columns), rows_(rows) {
    rock_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 1);
  }
  bool isRock(int column, int row) const {
    return column <= 0 || row <= 0 || column >= columns_ - 1 || row >= rows_ - 1 || rock_[index(column, row)] != 0;
  }
  void set(int column, int row, bool is_rock) { rock_[index(column, row)] = is_rock ? 1 : 0; }
  int rockAround(int column, int row) const {
    int count = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) count += isRock(column + dx, row + dy) ? 1 : 0;
    }
    return count;
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  int columns_, rows_;
  std::vector<std::uint8_t> rock_;
};

Cave smoothed(const Cave& cave) {
  Cave next(cave.columns(), cave.rows());
  for (int row = 0; row < cave.rows(); ++row) {
    for (int column = 0; column < cave.columns(); ++column)
      next.set(column, row, cave.rockAround(column, row) >= kRockAround);
  }
  return next;
}

/// The rock as boxes of merged cells.
void addRock(const Cave& cave, const Bounds2D& bounds, std::vector<WorldObject>& objects) {
  CellMerger merger;
  for (int row = 0; row < cave.rows(); ++row) {
    for (int column = 0; column < cave.columns(); ++column) {
      if (!cave.isRock(column, row)) continue;
      const int first = column;
      while (column + 1 < cave.columns() && cave.isRock(column + 1, row)) ++column;
      merger.add(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(first),
                 static_cast<std::uint32_t>(column + 1));
    }
  }
  for (const CellRectangle& cells : merger.finish()) {
    const double length_m = cells.columns * kCell_m, width_m = cells.rows * kCell_m;
    objects.push_back(wall("Rock" + std::to_string(objects.size() + 1),
                           bounds.x_min + cells.column * kCell_m + length_m / 2,
                           bounds.y_min + cells.row * kCell_m + width_m / 2, length_m, width_m));
  }
}

}  // namespace

Scenery generateCave(const CaveOptions& o, std::uint64_t seed) {
  requireWithin("width", o.width_m, 5, 1000);
  requireWithin("length", o.length_m, 5, 1000);
  requireWithin("rock", o.rock, 0, 0.6);
  Cave cave(static_cast<int>(o.width_m / kCell_m), static_cast<int>(o.length_m / kCell_m));
  Rng rng(seed, RandomPurpose::scenery);
  for (int row = 0; row < cave.rows(); ++row) {
    for (int column = 0; column < cave.columns(); ++column) cave.set(column, row, rng.uniform() < o.rock);
  }
  for (int i = 0; i < kRounds; ++i) cave = smoothed(cave);
  Scenery scenery;
  const double x_m = cave.columns() * kCell_m / 2, y_m = cave.rows() * kCell_m / 2;
  scenery.bounds = {-x_m, x_m, -y_m, y_m};
  addRock(cave, scenery.bounds, scenery.objects);
  scenery.places = placesAmong(scenery.objects, scenery.bounds, kCell_m / 2, 0.4);
  return scenery;
}

}  // namespace robosim
