#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel_executor.h"
#include "geometry/casting/double_pair.h"
#include "geometry/index/culling.h"
#include "geometry/index/grid_index.h"
#include "geometry/shapes/ray.h"

namespace robosim {

/// Uniform grid of the solids' centres, for small solids that move and are indexed again in each step. Each solid is
/// listed once, in the cell of its centre; queries extend their area by the largest solid's radius. The cells of a row
/// are contiguous in memory, so an area query reads one contiguous range per row. Border cells extend outwards without
/// limit. build() derives the grid's area and cell size from the solids: about one solid per cell where most of them
/// are, independent of the extent of the world.
class CenterIndex {
 public:
  /// Entry of a cell: all that culling reads, so that culled solids cost no further memory access.
  using Entry = IndexedDisc;

  /// @param middle reference point of the entries' CullDisc coordinates, world frame
  explicit CenterIndex(std::size_t solids, const mrpt::math::TPoint2D& middle = {});

  /// Sets a solid. Takes effect with build().
  void set(std::size_t i, const Solid& solid) { items_[i] = GridItem::from(solid); }
  /// Removes a solid from all queries, until set(). Takes effect with build().
  void remove(std::size_t i) { items_[i] = GridItem::removed(); }
  /// The same index, bit for bit, for any number of threads.
  void build(const ParallelExecutor& workers = ParallelExecutor(1));
  /// The same for some solids, each once. No query finds the others until the next build.
  void build(const ParallelExecutor& workers, std::span<const std::uint32_t> solids);

  /// The solids, in the order given, removed ones included.
  std::span<const GridItem> items() const { return items_; }
  const mrpt::math::TPoint2D& middle() const { return middle_; }

  /// Calls visit(entry) once for each solid that may overlap `area`.
  template <typename Visit>
  void visitNear(const Bounds2D& area, const Visit& visit) const {
    forRows(area, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) visit(entries_[i]);
    });
  }
  /// Calls visit(index) once for each solid that a test may contain, four of which are tested together.
  template <typename Visit>
  void visitNear(const RangeCull& cull, const Visit& visit) const {
    const Entry* const entries = entries_.data();
    const RangeCull kept = cull;  // so that its vectors may stay in registers
    forRows(cull.bounds(), [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; i += kTogether) {
        const Entry* const four = entries + i;
        std::uint32_t found = kept.mayContain(FourCullDiscs(four));
        if (end - i < kTogether) found &= (1U << (end - i)) - 1;
        for (; found != 0; found &= found - 1) visit(four[std::countr_zero(found)].index);
      }
    });
  }

  /// Calls visit(entry) once for each solid that the ray may intersect nearer than reach(). reach() may decrease
  /// between calls.
  template <typename Reach, typename Visit>
  void visitAlong(const Ray& ray, const Reach& reach, const Visit& visit) const {
    const double out = reach_max_m_ + kMargin_m;
    double from = 0;
    double to = std::min(reach(), std::numeric_limits<double>::max());  // finite, also for a vertical ray
    clip(ray.origin.x, ray.direction.x, centers_.x_min - out, centers_.x_max + out, from, to);
    clip(ray.origin.y, ray.direction.y, centers_.y_min - out, centers_.y_max + out, from, to);
    if (from > to) return;
    const double y_from = ray.origin.y + from * ray.direction.y;
    const double y_to = ray.origin.y + to * ray.direction.y;
    const bool up = y_to >= y_from;
    int r = row(up ? y_from - out : y_from + out);
    const int last = row(up ? y_to + out : y_to - out);
    for (;; r += r < last ? 1 : -1) {
      // The interval of the ray that lies within `out` of the row.
      double begin = from;
      double end = std::min(to, reach());
      clip(ray.origin.y, ray.direction.y, r == 0 ? -kInfinity : yOf(r) - out,
           r == rows_ - 1 ? kInfinity : yOf(r + 1) + out, begin, end);
      if (begin <= end) {
        const double x1 = ray.origin.x + begin * ray.direction.x;
        const double x2 = ray.origin.x + end * ray.direction.x;
        visitRow(r, std::min(x1, x2) - out, std::max(x1, x2) + out, visit);
      }
      if (r == last) return;
    }
  }

 private:
  /// Chooses the grid's area and cell size from the solids' centres.
  /// @param order indices of the solids to be indexed
  template <typename Order>
  void chooseCells(const ParallelExecutor& workers, const Order& order);
  template <typename Order>
  void buildFrom(const ParallelExecutor& workers, const Order& order);
  /// The same as buildFrom() of a single solid, such as the only robot of a world, in a tenth of its time.
  void buildOne(std::size_t solid);
  template <typename Order>
  void sortInParallel(const ParallelExecutor& workers, const Order& order);

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kMargin_m = 1e-6;      ///< exceeds all rounding errors
  static constexpr std::uint32_t kTogether = 4;  ///< entries that are tested together

  int column(double x) const { return cellOf((x - area_.x_min) * per_m_, columns_); }
  int row(double y) const { return cellOf((y - area_.y_min) * per_m_, rows_); }
  double yOf(int row) const { return area_.y_min + row * cell_m_; }
  std::size_t cellAt(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  /// Calls visit(begin, end) for the entries in the cells of each row that may overlap `area`.
  template <typename Visit>
  void forRows(const Bounds2D& area, const Visit& visit) const {
    // As column() and row(), for both axes together.
    const DoublePair low{area.x_min - reach_max_m_, area.y_min - reach_max_m_};
    const DoublePair high{area.x_max + reach_max_m_, area.y_max + reach_max_m_};
    const DoublePair origin{area_.x_min, area_.y_min};
    const DoublePair last{columns_ - 1.0, rows_ - 1.0};
    const DoublePair zero{0, 0};
    const DoublePair first_cell = min(last, max((low - origin) * per_m_, zero));
    const DoublePair last_cell = min(last, max((high - origin) * per_m_, zero));
    const auto width = static_cast<std::ptrdiff_t>(last_cell[0]) - static_cast<std::ptrdiff_t>(first_cell[0]) + 1;
    const auto rows = static_cast<std::ptrdiff_t>(last_cell[1]) - static_cast<std::ptrdiff_t>(first_cell[1]) + 1;
    const std::uint32_t* begin = begin_.data() + static_cast<std::ptrdiff_t>(first_cell[1]) * columns_ +
                                 static_cast<std::ptrdiff_t>(first_cell[0]);
    for (std::ptrdiff_t r = 0; r < rows; ++r, begin += columns_) visit(begin[0], begin[width]);
  }
  template <typename Visit>
  void visitRow(int row, double x_min, double x_max, const Visit& visit) const {
    const std::uint32_t end = begin_[cellAt(row, column(x_max)) + 1];
    for (std::uint32_t i = begin_[cellAt(row, column(x_min))]; i < end; ++i) visit(entries_[i]);
  }

  /// Clips [from, to] to where origin + t·direction lies in [low, high].
  static void clip(double origin, double direction, double low, double high, double& from, double& to) {
    if (direction == 0) {
      if (origin < low || origin > high) to = -1;
      return;
    }
    const double a = (low - origin) / direction;
    const double b = (high - origin) / direction;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }

  mrpt::math::TPoint2D middle_;
  Bounds2D area_;
  double cell_m_ = 1, per_m_ = 1;
  int columns_ = 1, rows_ = 1;
  double reach_max_m_ = 0;
  Bounds2D centers_;                  ///< bounds of all centres
  std::vector<std::uint32_t> begin_;  ///< first entry per cell, and the end
  std::vector<GridItem> items_;       ///< in the order given
  std::vector<std::uint32_t> cell_;   ///< cell of each solid
  std::vector<Entry> entries_;        ///< sorted by cell, then kTogether - 1 unused ones
  struct CellOf {
    std::uint32_t cell = 0, solid = 0;
  };
  std::vector<CellOf> by_part_;  ///< of sortInParallel(): solids by part of the grid
};

}  // namespace robosim
