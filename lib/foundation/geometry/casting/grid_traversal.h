#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>

#include "geometry/casting/double_pair.h"
#include "geometry/index/grid_index.h"

namespace robosim {

/// Converts a point to cell units from a grid's lower left corner; and whether such a point lies inside the grid.
///@{
[[gnu::always_inline]] inline DoublePair inCells(const GridIndex& grid, const DoublePair& place) {
  return (place - pairOf(grid.low())) * grid.perMetre();
}
[[gnu::always_inline]] inline bool contains(const GridIndex& grid, const DoublePair& in_cells) {
  const Int64Pair is_in = (in_cells >= 0) & (in_cells < pairOf(grid.cells()));
  return (is_in[0] & is_in[1]) != 0;
}
///@}

/// Traversal of the cells along a planar ray that starts inside a grid, until its reach or the border of the grid
/// (Amanatides & Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987). GridIndex::visitAlong()
/// is the same for rays that start anywhere, with distances in doubles. Which border comes next is an unpredictable
/// branch, so the step here is branch-free. Distances are integers in units of 2^-44 of a cell, because g++ compiles
/// the integer selection without a branch but not that of doubles. Borders at kFar, 131,072 cells, are never reached: a
/// grid has at most 32,768 cells a side.
class GridTraversal {
 public:
  /// @param in the ray's origin in cell units, inside the grid
  [[gnu::always_inline]] GridTraversal(const GridIndex& grid, const DoublePair& in, const DoublePair& direction)
      : units_per_m_(kUnits * grid.perMetre()) {
    const auto column = static_cast<std::int64_t>(in[0]);
    const auto row = static_cast<std::int64_t>(in[1]);
    const std::int64_t columns = grid.columns();
    pack_ = grid.packs().data() + (row * columns + column);

    const DoublePair cell{static_cast<double>(column), static_cast<double>(row)};
    const Int64Pair down = reinterpret_cast<Int64Pair>(direction) >> 63;  // -1 for yes, 0 for no
    const DoublePair border = cell + 1 - select(down, broadcast(1));
    const DoublePair cells = pairOf(grid.cells());
    const DoublePair grid_border = cells - select(down, cells);
    const DoublePair per = kUnits / direction;
    const Int64Pair next = __builtin_convertvector(capped((border - in) * per), Int64Pair);
    const Int64Pair between = __builtin_convertvector(capped(absolute(per)), Int64Pair);
    const DoublePair to_grid_border = capped((grid_border - in) * per);
    // Ends slightly before the border, because the distances to the borders accumulate rounding errors.
    to_grid_border_ = min(to_grid_border, swapped(to_grid_border)) - kGridBorderMargin;

    next_x_ = next[0];
    next_y_ = next[1];
    between_x_ = between[0];
    between_y_ = between[1];
    step_x_ = (1 ^ down[0]) - down[0];
    step_y_ = (columns ^ down[1]) - down[1];
  }

  /// The first pack of the current cell.
  const CellPack* pack() const { return pack_; }

  /// Limits the traversal to a distance of at least 0 from the ray's origin; NaN limits it to the grid's border. Must
  /// be called before advance().
  [[gnu::always_inline]] void setReach(double reach_m) {
    reach_ = static_cast<std::int64_t>(min(inUnits(reach_m), to_grid_border_)[0]);
  }
  /// Whether the ray leaves the grid within a distance.
  bool leavesWithin(double reach_m) const { return inUnits(reach_m)[0] >= to_grid_border_[0]; }

  /// Advances to the next cell; returns false when it begins at or beyond the limit.
  [[gnu::always_inline]] bool advance() {
    const std::int64_t less = next_x_ - next_y_;
    const std::int64_t in_x = less >> 63;
    const std::int64_t next = std::min(next_x_, next_y_);
    if (next >= reach_) return false;
    pack_ += less < 0 ? step_x_ : step_y_;
    next_x_ += between_x_ & in_x;
    next_y_ += between_y_ & ~in_x;
    return true;
  }

 private:
  static constexpr double kUnits = std::int64_t{1} << 44;
  static constexpr double kFar = std::int64_t{1} << 61;
  /// More than the accumulated rounding error of a traversal, and less than GridIndex::borderMargin().
  static constexpr double kGridBorderMargin = std::int64_t{1} << 20;

  static DoublePair select(const Int64Pair& is, const DoublePair& value) {
    return reinterpret_cast<DoublePair>(is & reinterpret_cast<Int64Pair>(value));
  }
  static DoublePair absolute(const DoublePair& value) {
    return reinterpret_cast<DoublePair>(reinterpret_cast<Int64Pair>(value) & std::numeric_limits<std::int64_t>::max());
  }
  /// For a ray parallel to an axis the borders of the other axis are at infinity; for a ray on such a border the
  /// distance is NaN. Both become kFar.
  static DoublePair capped(const DoublePair& way) { return min(way, broadcast(kFar)); }
  DoublePair inUnits(double distance_m) const { return DoublePair{distance_m * units_per_m_, 0}; }

  double units_per_m_;
  DoublePair to_grid_border_;  ///< distance to the border, in the first lane
  const CellPack* pack_;
  std::int64_t next_x_, next_y_;        ///< distance from the origin to the next border
  std::int64_t between_x_, between_y_;  ///< distance between borders
  std::int64_t step_x_, step_y_;        ///< offset to the next cell's pack
  std::int64_t reach_ = 0;
};

}  // namespace robosim
