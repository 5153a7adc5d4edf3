#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/cell_pack.h"
#include "geometry/ray.h"
#include "geometry/two.h"

namespace robosim {

/// A ray whose direction has less than this of an axis crosses no border on it: its next one would be too far for a
/// number.
constexpr double kLeastSlope = 1e-300;

/// As many as a grid has a side at most.
constexpr int kMostCells = 32768;
/// How many cells of a size cover an extent: at least 1, and no more than kMostCells.
int cellsIn(double extent_m, double cell_m);
/// The cell of a coordinate that is counted in cells, pulled onto the rim when it lies outside.
inline int cellOf(double in_cells, int count) {
  // Cast only what is in range: a far coordinate would not fit an int.
  if (!(in_cells > 0)) return 0;
  return in_cells < count ? static_cast<int>(in_cells) : count - 1;
}

/// Which solids reach into which square cell of the plane. Solids beyond the grid's area are listed in the cells of its
/// rim, which stand for all that lies outwards of them.
class GridIndex {
 public:
  GridIndex(const Bounds2D& area, double cell_m);

  /// Lists each solid in every cell that its outline reaches.
  void build(std::span<const Solid> solids);

  /// The solids, by the cell of their centre: those near each other in the plane are so in memory, too, for who asks
  /// about one soon asks about the other. Indices here are of this order; GridItem::number tells the one given.
  std::span<const GridItem> items() const { return items_; }
  std::span<const RoughSolid> rough() const { return rough_; }
  /// The index of a solid by its number.
  std::uint32_t indexOf(std::size_t number) const { return index_of_[number]; }
  /// From where the rough solids are seen.
  mrpt::math::TPoint2D middle() const { return middle_; }

  double cellSize() const { return cell_m_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double xMin() const { return area_.x_min; }
  double yMin() const { return area_.y_min; }
  /// Column or row of a coordinate, pulled onto the rim when it lies outside.
  int column(double x) const { return cellOf((x - area_.x_min) * per_m_, columns_); }
  int row(double y) const { return cellOf((y - area_.y_min) * per_m_, rows_); }
  /// Calls visit(index) for each solid that a cell lists.
  template <typename Visit>
  void visitCell(int column, int row, const Visit& visit) const {
    visitCell(cellAt(column, row), visit);
  }

  /// The first pack of each cell, row by row from the lower left; and after those the others.
  std::span<const CellPack> packs() const { return packs_; }
  /// The same solids as in a pack once more, where many are long and their discs cover much besides; else null.
  const CellRectangles* rectanglesOf(const CellPack* pack) const {
    return rectangles_.empty() ? nullptr : &rectangles_[static_cast<std::size_t>(pack - packs_.data())];
  }
  /// A place in cells from the lower left corner, and whether that is inside the grid.
  ///@{
  [[gnu::always_inline]] Two inCells(const Two& place) const { return (place - low_) * per_m_; }
  [[gnu::always_inline]] bool holds(const Two& in_cells) const {
    const TwoWhole is_in = (in_cells >= 0) & (in_cells < cells_);
    return (is_in[0] & is_in[1]) != 0;
  }
  ///@}
  /// Whether no solid reaches beyond the grid, nor nearer to its rim than roomAtRim().
  bool holdsAll() const { return holds_all_; }
  /// More than GridWalk ends before the rim [m].
  static double roomAtRim(double cell_m);
  double perMetre() const { return per_m_; }
  Two cells() const { return cells_; }

  /// Whether a cell goes on outwards without end.
  bool isOnRim(int column, int row) const {
    return column == 0 || row == 0 || column == columns_ - 1 || row == rows_ - 1;
  }

  /// Calls visit(index) for the solids of the cells that a ray goes through, in its order, until the next cell begins
  /// at or beyond reach(). Cells on the rim go on outwards without end. GridWalk is quicker, for a ray that starts
  /// inside.
  template <typename Reach, typename Visit>
  void visitAlong(const Ray& ray, const Reach& reach, const Visit& visit) const {
    const int first_column = column(ray.origin.x);
    const int first_row = row(ray.origin.y);
    std::size_t at = cellAt(first_column, first_row);
    Walk x = walk(ray.origin.x, ray.direction.x, area_.x_min, first_column, columns_, 1);
    Walk y = walk(ray.origin.y, ray.direction.y, area_.y_min, first_row, rows_, columns_);
    while (true) {
      visitCell(at, visit);
      Walk& next = x.next_m < y.next_m ? x : y;
      if (!(next.next_m < reach())) return;
      at += static_cast<std::size_t>(next.step);
      next.cross();
    }
  }

 private:
  /// The way along one axis.
  struct Walk {
    double next_m = std::numeric_limits<double>::infinity();  ///< distance along the ray to the next border
    double delta_m = 0;                                       ///< and between borders
    int left = 0;                                             ///< borders still to cross before the rim
    int step = 0;                                             ///< to the number of the next cell

    void cross() { next_m = --left > 0 ? next_m + delta_m : std::numeric_limits<double>::infinity(); }
  };
  Walk walk(double origin, double direction, double low, int cell, int count, int stride) const {
    const bool down = std::signbit(direction);
    const int left = down ? cell : count - 1 - cell;
    if (left == 0 || std::abs(direction) <= kLeastSlope) return {};
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
    for (; pack->goesOn(); pack = &packs_[pack->next()]) pack->visit(visit);
    pack->visit(visit);
  }
  /// Sets the items, by the cell of their centre.
  void sort(std::span<const Solid> solids);
  /// Makes room for so many solids in each cell.
  void makePacks(const std::vector<std::uint32_t>& counts);
  bool holdsAll(const GridItem& item) const;
  bool areManyLong() const;
  /// What single precision loses at most of where a solid is, seen from anywhere on the grid [m].
  double lost(const GridItem& item) const;
  template <typename Visit>
  void forCells(const GridItem& item, const Visit& visit) const;

  Bounds2D area_;
  double cell_m_, per_m_;
  int columns_, rows_;
  mrpt::math::TPoint2D middle_;
  Two low_, cells_;  ///< the lower left corner, and how many cells there are
  bool holds_all_ = true;
  std::vector<GridItem> items_;             ///< one per solid
  std::vector<RoughSolid> rough_;           ///< one per solid
  std::vector<std::uint32_t> index_of_;     ///< by number
  std::vector<CellPack> packs_;             ///< by cell, and then those that others go on in
  std::vector<CellRectangles> rectangles_;  ///< of each pack, or none
};

}  // namespace robosim
