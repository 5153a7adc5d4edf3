#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/grid_index.h"
#include "geometry/ray.h"

namespace robosim {

/// Solids by the square cell that their centre lies in: for small ones that move, and are indexed anew in each step.
/// Each is listed once; in return questions look further, by the reach of the largest. Cells of a row lie side by side
/// in memory, so a question about an area reads one run of memory a row. Cells of the rim stand for all that lies
/// outwards of them.
class CenterIndex {
 public:
  /// A solid as its cell lists it: all that tells whether it matters, so that nothing else is read of those that don't.
  struct Entry {
    RoughSolid solid;
    std::uint32_t index = 0;
  };

  CenterIndex(const Bounds2D& area, double cell_m, std::size_t solids);

  /// Sets a solid; takes effect with build().
  void set(std::size_t i, const Solid& solid) { items_[i] = GridItem::from(solid, static_cast<std::uint32_t>(i)); }
  void build();

  /// The solids, in the order given.
  std::span<const GridItem> items() const { return items_; }
  /// From where the rough solids are seen.
  mrpt::math::TPoint2D middle() const { return {(area_.x_min + area_.x_max) / 2, (area_.y_min + area_.y_max) / 2}; }

  /// Calls visit(entry) for each solid that may reach into `area`, each once.
  template <typename Visit>
  void visitNear(const Bounds2D& area, const Visit& visit) const {
    const int top = row(area.y_max + reach_max_m_);
    for (int r = row(area.y_min - reach_max_m_); r <= top; ++r) {
      visitRow(r, area.x_min - reach_max_m_, area.x_max + reach_max_m_, visit);
    }
  }

  /// Calls visit(entry) for each solid that a ray may meet before reach(), each once; reach() may shrink meanwhile.
  template <typename Reach, typename Visit>
  void visitAlong(const Ray& ray, const Reach& reach, const Visit& visit) const {
    const double out = reach_max_m_ + kMargin_m;
    double from = 0;
    double to = std::min(reach(), std::numeric_limits<double>::max());  // a number even along an upright ray
    clip(ray.origin.x, ray.direction.x, centers_.x_min - out, centers_.x_max + out, from, to);
    clip(ray.origin.y, ray.direction.y, centers_.y_min - out, centers_.y_max + out, from, to);
    if (from > to) return;
    const double y_from = ray.origin.y + from * ray.direction.y;
    const double y_to = ray.origin.y + to * ray.direction.y;
    const bool up = y_to >= y_from;
    int r = row(up ? y_from - out : y_from + out);
    const int last = row(up ? y_to + out : y_to - out);
    for (;; r += r < last ? 1 : -1) {
      // The part of the ray that comes near enough to the row.
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
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kMargin_m = 1e-6;  ///< more than any rounding on the way

  int column(double x) const { return cellOf((x - area_.x_min) * per_m_, columns_); }
  int row(double y) const { return cellOf((y - area_.y_min) * per_m_, rows_); }
  double yOf(int row) const { return area_.y_min + row * cell_m_; }
  std::size_t cellAt(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  template <typename Visit>
  void visitRow(int row, double x_min, double x_max, const Visit& visit) const {
    const std::uint32_t end = begin_[cellAt(row, column(x_max)) + 1];
    for (std::uint32_t i = begin_[cellAt(row, column(x_min))]; i < end; ++i) visit(entries_[i]);
  }

  /// Keeps of [from, to] where origin + t·direction lies in [low, high].
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

  Bounds2D area_;
  double cell_m_, per_m_;
  int columns_, rows_;
  double reach_max_m_ = 0;
  Bounds2D centers_;                  ///< of all solids
  std::vector<std::uint32_t> begin_;  ///< by cell, and the end
  std::vector<GridItem> items_;       ///< as given
  std::vector<std::uint32_t> cell_;   ///< of each
  std::vector<Entry> entries_;        ///< by cell
};

}  // namespace robosim
