#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "environment/robot_range.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// Cells [begin, end) of an AreaGrid, numbered by rows.
struct CellRange {
  std::uint32_t begin = 0, end = 0;
  bool operator==(const CellRange&) const = default;
};
/// A part of the surface, in ascending order of cells, without common ones.
using Area = std::vector<CellRange>;

/// A coarse grid over the surface of a world. Its border cells extend outwards without limit. Its number of cells is
/// limited in proportion to that of robots, and so are the time and memory of the functions below.
class AreaGrid {
 public:
  /// @param reach_m distance for which around() is called
  AreaGrid(const Bounds2D& surface, std::size_t robots, double reach_m);

  std::uint32_t cells() const { return columns_ * rows_; }
  std::uint32_t cellAt(const mrpt::math::TPose2D& pose) const { return row(pose.y) * columns_ + column(pose.x); }
  /// All points within `reach_m` of some robots, and some that are farther away by up to a cell.
  /// @param poses of all robots
  Area around(std::span<const mrpt::math::TPose2D> poses, RobotRange robots, double reach_m) const;

 private:
  static std::uint32_t index(double cells, std::uint32_t count) {
    return cells > 0 ? static_cast<std::uint32_t>(std::min(cells, count - 1.0)) : 0;
  }
  std::uint32_t column(double x) const { return index((x - x_min_m_) / cell_m_, columns_); }
  std::uint32_t row(double y) const { return index((y - y_min_m_) / cell_m_, rows_); }

  double x_min_m_, y_min_m_;
  double cell_m_;
  std::uint32_t columns_, rows_;
};

/// Appends an area's bytes, in the machine's byte order.
void writeArea(const Area& area, std::string& out);
/// @param cells of the grid @throws std::runtime_error for bytes that writeArea() cannot have written
Area readArea(std::string_view bytes, std::uint32_t cells);

/// Robots by the cells in which they are.
class RobotsByCell {
 public:
  explicit RobotsByCell(const AreaGrid& grid) : grid_(grid) {}

  /// Replaces them. @param poses of all robots
  void assign(std::span<const mrpt::math::TPose2D> poses, RobotRange robots);
  /// Appends those in an area, in any order.
  void addWithin(const Area& area, std::vector<std::uint32_t>& found) const;

 private:
  const AreaGrid& grid_;
  CellRange cells_;                    ///< contains all robots
  std::vector<std::uint32_t> begin_;   ///< of each of cells_ in robots_, and the end
  std::vector<std::uint32_t> robots_;  ///< sorted by cell
  std::vector<std::uint32_t> cell_;    ///< of each robot, in the order assigned
};

}  // namespace robosim
