#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/solid.h"

namespace robosim {

/// Which solids reach into which square cell of the plane. Built by counting sort: linear time, no allocation once the
/// arrays have their size. Solids beyond the grid's area are listed in the cells of its rim, which stand for all
/// that lies outwards of them.
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
  int column(double x) const;
  int row(double y) const;
  /// Indices of the solids in a cell, ascending.
  std::span<const std::uint32_t> cell(int column, int row) const {
    const std::size_t i =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    return {items_.data() + begin_[i], items_.data() + begin_[i + 1]};
  }

 private:
  template <typename Visit>
  void forCells(const Solid&, const Visit& visit) const;

  Bounds2D area_;
  double cell_m_, per_m_;
  int columns_, rows_;
  std::vector<std::uint32_t> begin_, items_;
};

}  // namespace robosim
