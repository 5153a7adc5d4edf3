#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/index/cell_pack.h"
#include "geometry/shapes/ray.h"

namespace robosim {

/// A ray whose direction component along an axis does not exceed this crosses no cell border on that axis: the distance
/// to the next one would overflow.
constexpr double kMinSlope = 1e-300;

/// Maximum number of cells along each side of a grid.
constexpr int kMaxCells = 32768;
/// Number of cells of a size that cover an extent, clamped to [1, kMaxCells].
int cellsIn(double extent_m, double cell_m);
/// Cell of a coordinate given in cell units, clamped to [0, count - 1].
inline int cellOf(double in_cells, int count) {
  // Casts only values in range: a far coordinate would overflow an int.
  if (!(in_cells > 0)) return 0;
  return in_cells < count ? static_cast<int>(in_cells) : count - 1;
}

/// Uniform grid of stationary solids: each cell lists the solids that overlap it. Border cells extend outwards without
/// limit and list the solids beyond the grid's area.
class GridIndex {
 public:
  GridIndex(const Bounds2D& area, double cell_m);

  /// Lists each solid in every cell that its outline overlaps.
  void build(std::span<const Solid> solids);

  /// The solids, sorted by the cell of their centre, so that neighbours in the plane are close in memory: consecutive
  /// queries often read neighbours. Indices in this class refer to this order.
  std::span<const GridItem> items() const { return items_; }
  /// Position of a solid in the order given to build(), by its index, and the reverse.
  ///@{
  std::uint32_t numberOf(std::uint32_t index) const { return number_of_[index]; }
  std::uint32_t indexOf(std::size_t number) const { return index_of_[number]; }
  ///@}
  /// Reference point of the coordinates in single precision, world frame.
  mrpt::math::TPoint2D middle() const { return middle_; }

  double cellSize() const { return cell_m_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// The lower left corner.
  const mrpt::math::TPoint2D& low() const { return low_; }
  /// Columns and rows, as numbers for arithmetic.
  const mrpt::math::TPoint2D& cells() const { return cells_; }
  /// Column or row of a coordinate, clamped to the grid.
  int column(double x) const { return cellOf((x - area_.x_min) * per_m_, columns_); }
  int row(double y) const { return cellOf((y - area_.y_min) * per_m_, rows_); }
  /// Calls visit(index) for each solid in a cell's list.
  template <typename Visit>
  void visitCell(int column, int row, const Visit& visit) const {
    visitCell(cellAt(column, row), visit);
  }
  /// Calls visit(index) for each solid in the list of each cell that intersects an area. A solid listed in several
  /// cells is visited several times.
  template <typename Visit>
  void visitArea(const Bounds2D& area, const Visit& visit) const {
    const int right = column(area.x_max);
    const int top = row(area.y_max);
    for (int y = row(area.y_min); y <= top; ++y) {
      for (int x = column(area.x_min); x <= right; ++x) visitCell(x, y, visit);
    }
  }

  /// Calls visit(index) for the solids that may lie within `reach_m` of a point; for one in several cells, several
  /// times.
  template <typename Visit>
  void visitNear(const mrpt::math::TPoint2D& at, double reach_m, const Visit& visit) const {
    const Bounds2D area{at.x - reach_m, at.x + reach_m, at.y - reach_m, at.y + reach_m};
    // Beyond the grid, the margin of the packs' discs does not cover the rounding error.
    if (!area_.contains(at)) return visitArea(area, visit);
    const auto at_x = static_cast<float>(at.x - middle_.x);
    const auto at_y = static_cast<float>(at.y - middle_.y);
    // At most half of the largest number, so that unused entries of packs never match.
    const auto wider_m =
        static_cast<float>(std::min(reach_m * (1 + kCullRelativeError), double{std::numeric_limits<float>::max()} / 2));
    const int left = column(area.x_min), right = column(area.x_max);
    const int top = row(area.y_max);
    for (int y = row(area.y_min); y <= top; ++y) {
      const CellPack* const first = &packs_[cellAt(left, y)];
      for (const CellPack* cell = first; cell <= first + (right - left); ++cell) {
        const CellPack* pack = cell;
        for (; pack->hasNext(); pack = &packs_[pack->next()]) pack->visitNear(at_x, at_y, wider_m, visit);
        pack->visitNear(at_x, at_y, wider_m, visit);
      }
    }
  }

  /// The first pack of each cell, row by row from the lower left, followed by the linked packs.
  std::span<const CellPack> packs() const { return packs_; }
  /// Rectangles of a pack's solids; null unless many solids are elongated, so that their discs would cover much free
  /// space.
  const CellRectangles* rectanglesOf(const CellPack* pack) const {
    return rectangles_.empty() ? nullptr : &rectangles_[static_cast<std::size_t>(pack - packs_.data())];
  }
  /// Whether every solid lies inside the grid, at least borderMargin() from its border.
  bool containsAll() const { return contains_all_; }
  /// Margin [m] at the border; more than the distance from it at which GridTraversal ends.
  static double borderMargin(double cell_m);
  double perMetre() const { return per_m_; }

  /// Whether a cell is a border cell, which extends outwards without limit.
  bool isBorderCell(int column, int row) const {
    return column == 0 || row == 0 || column == columns_ - 1 || row == rows_ - 1;
  }

  /// Calls visit(index) for the solids of the cells along a ray, in the ray's order, until the next cell begins at or
  /// beyond reach(). Border cells extend outwards without limit. For a ray that starts inside the grid, GridTraversal
  /// is faster.
  template <typename Reach, typename Visit>
  void visitAlong(const Ray& ray, const Reach& reach, const Visit& visit) const {
    const int first_column = column(ray.origin.x);
    const int first_row = row(ray.origin.y);
    std::size_t at = cellAt(first_column, first_row);
    AxisState x = axisState(ray.origin.x, ray.direction.x, area_.x_min, first_column, columns_, 1);
    AxisState y = axisState(ray.origin.y, ray.direction.y, area_.y_min, first_row, rows_, columns_);
    while (true) {
      visitCell(at, visit);
      AxisState& next = x.next_m < y.next_m ? x : y;
      if (!(next.next_m < reach())) return;
      at += static_cast<std::size_t>(next.step);
      next.cross();
    }
  }

 private:
  /// Traversal state along one axis.
  struct AxisState {
    double next_m = std::numeric_limits<double>::infinity();  ///< distance along the ray to the next border
    double delta_m = 0;                                       ///< distance between borders
    int left = 0;                                             ///< borders left before the last cell
    int step = 0;                                             ///< added to the cell number at a border

    void cross() { next_m = --left > 0 ? next_m + delta_m : std::numeric_limits<double>::infinity(); }
  };
  AxisState axisState(double origin, double direction, double low, int cell, int count, int stride) const {
    const bool down = std::signbit(direction);
    const int left = down ? cell : count - 1 - cell;
    if (left == 0 || std::abs(direction) <= kMinSlope) return {};
    const double next_m = (low + (cell + (down ? 0 : 1)) * cell_m_ - origin) / direction;
    return {next_m > 0 ? next_m : 0.0, cell_m_ / std::abs(direction), left, down ? -stride : stride};
  }

  std::size_t cellCount() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
  std::size_t cellAt(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  template <typename Visit>
  void visitCell(std::size_t at, const Visit& visit) const {
    const CellPack* pack = &packs_[at];
    for (; pack->hasNext(); pack = &packs_[pack->next()]) pack->visit(visit);
    pack->visit(visit);
  }
  /// Sets the items, sorted by the cell of their centre.
  void sort(std::span<const Solid> solids);
  /// Allocates the packs for the given number of solids per cell.
  void allocatePacks(const std::vector<std::uint32_t>& counts);
  bool containsAll(const GridItem& item) const;
  bool areManyElongated() const;
  /// Upper bound [m] of the rounding error of a solid's position in single precision, relative to any point of the
  /// grid.
  double roundingError(const GridItem& item) const;
  template <typename Visit>
  void forCells(const GridItem& item, const Visit& visit) const;

  Bounds2D area_;
  double cell_m_, per_m_;
  int columns_, rows_;
  mrpt::math::TPoint2D middle_, low_, cells_;
  bool contains_all_ = true;
  std::vector<GridItem> items_;             ///< one per solid
  std::vector<std::uint32_t> number_of_;    ///< by index
  std::vector<std::uint32_t> index_of_;     ///< by number
  std::vector<CellPack> packs_;             ///< first pack per cell, then the linked packs
  std::vector<CellRectangles> rectangles_;  ///< one per pack, or empty
};

}  // namespace robosim
