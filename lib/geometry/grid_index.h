#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/solid.h"

namespace robosim {

/// A solid as a grid keeps it: all that a question asks of it, in one run of memory.
struct GridItem {
  double x = 0, y = 0;            ///< centre [m]
  double axis_x = 1, axis_y = 0;  ///< box: unit vector along its length
  double half_length_m = 0;       ///< circle: its radius
  double half_width_m = 0;        ///< circle: 0
  double reach_m = 0;             ///< radius of the disc about its centre that covers it
  HeightSpan heights;
  std::uint32_t index = 0;  ///< in the order the solids were given
  bool is_circle = false;

  Bounds2D bounds() const;
};

/// Which solids reach into which square cell of the plane. Built by counting sort: linear time, no allocation once the
/// arrays have their size. Each cell's solids lie side by side in memory, copied, so that looking through a cell
/// touches nothing else. Solids beyond the grid's area are listed in the cells of its rim, which stand for all that
/// lies outwards of them.
class GridIndex {
 public:
  GridIndex(const Bounds2D& area, double cell_m);

  /// Lists each solid in every cell that its outline reaches.
  void build(std::span<const Solid> solids);

  double cellSize() const { return cell_m_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double xMin() const { return area_.x_min; }
  double yMin() const { return area_.y_min; }
  /// Column or row of a coordinate, pulled onto the rim when it lies outside.
  int column(double x) const { return cellOf((x - area_.x_min) * per_m_, columns_); }
  int row(double y) const { return cellOf((y - area_.y_min) * per_m_, rows_); }
  /// The solids in a cell, in the order they were given.
  std::span<const GridItem> cell(int column, int row) const {
    const std::size_t i =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    return {items_.data() + begin_[i], items_.data() + begin_[i + 1]};
  }

 private:
  static int cellOf(double in_cells, int count) {
    // Cast only what is in range: a far coordinate would not fit an int.
    if (!(in_cells > 0)) return 0;
    return in_cells < count ? static_cast<int>(in_cells) : count - 1;
  }
  template <typename Visit>
  void forCells(const GridItem& item, const Visit& visit) const;

  Bounds2D area_;
  double cell_m_, per_m_;
  int columns_, rows_;
  std::vector<std::uint32_t> begin_;
  std::vector<GridItem> given_;  ///< one per solid
  std::vector<GridItem> items_;  ///< by cell
};

}  // namespace robosim
