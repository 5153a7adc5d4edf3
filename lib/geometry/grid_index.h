#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/solid.h"

namespace robosim {

/// A solid as a grid keeps it: all that a question asks of it, in one run of memory. A box, or a circle as a box
/// without sides that is round by its radius: so that most questions are the same sum for both.
struct GridItem {
  double x = 0, y = 0;            ///< centre [m]
  double axis_x = 1, axis_y = 0;  ///< unit vector along the box's length
  double half_length_m = 0;
  double half_width_m = 0;
  double round_m = 0;  ///< radius of a circle; 0 for a box
  double reach_m = 0;  ///< radius of the disc about its centre that covers the solid
  HeightSpan heights;
  std::uint32_t index = 0;  ///< in the order the solids were given
  bool is_circle = false;

  static GridItem from(const Solid&, std::uint32_t index);
  Bounds2D bounds() const;
  /// Whether some of the solid outline lies no further than `far_m` from a point.
  bool isWithin(double far_m, const mrpt::math::TPoint2D& of) const {
    return squaredToBox(of) <= (far_m + round_m) * (far_m + round_m);
  }
  /// Distance [m] from a point to the solid outline; 0 inside.
  double distanceTo(const mrpt::math::TPoint2D& p) const { return std::max(0.0, std::sqrt(squaredToBox(p)) - round_m); }

 private:
  double squaredToBox(const mrpt::math::TPoint2D& p) const {
    const double ox = p.x - x;
    const double oy = p.y - y;
    const double beyond_a = std::max(0.0, std::abs(ox * axis_x + oy * axis_y) - half_length_m);
    const double beyond_b = std::max(0.0, std::abs(oy * axis_x - ox * axis_y) - half_width_m);
    return beyond_a * beyond_a + beyond_b * beyond_b;
  }
};

/// How many cells of a size cover an extent: at least 1, and no more than 32768.
int cellsIn(double extent_m, double cell_m);
/// The cell of a coordinate that is counted in cells, pulled onto the rim when it lies outside.
inline int cellOf(double in_cells, int count) {
  // Cast only what is in range: a far coordinate would not fit an int.
  if (!(in_cells > 0)) return 0;
  return in_cells < count ? static_cast<int>(in_cells) : count - 1;
}

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
  /// The solids, in the order given.
  std::span<const GridItem> items() const { return given_; }
  /// The solids in a cell, in the order they were given.
  std::span<const GridItem> cell(int column, int row) const {
    const std::size_t i =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    return {items_.data() + begin_[i], items_.data() + begin_[i + 1]};
  }

 private:
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
