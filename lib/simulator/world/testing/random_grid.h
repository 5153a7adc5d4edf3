#pragma once
#include "base/random.h"
#include "world/occupancy_grid.h"

namespace robosim {

/// Random grid for tests: some isolated cells and some rectangles of cells, so that both seams and single cells occur.
inline OccupancyGrid randomGrid(Rng& rng, std::uint32_t columns, std::uint32_t rows, double cell_m) {
  OccupancyGrid grid{columns, rows, cell_m, {}, {}};
  grid.cells.assign(std::size_t{columns} * rows, Occupancy::free);
  const double density = rng.uniform(0, 0.3);
  for (auto& cell : grid.cells) {
    if (rng.uniform() < density) cell = Occupancy::occupied;
    if (rng.uniform() < 0.02) cell = Occupancy::unknown;
  }
  for (auto blocks = rng.below(4); blocks > 0; --blocks) {
    const auto column = rng.below(columns), row = rng.below(rows);
    const auto right = std::min(columns, column + 1 + rng.below(6)), top = std::min(rows, row + 1 + rng.below(6));
    for (auto y = row; y < top; ++y) {
      for (auto x = column; x < right; ++x) grid.cells[std::size_t{y} * columns + x] = Occupancy::occupied;
    }
  }
  return grid;
}

}  // namespace robosim
