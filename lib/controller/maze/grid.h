#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include <mrpt/math/TPoint2D.h>

namespace robosim {

/// Index of a grid cell by column and row; the lower left corner of (0, 0) is the frame's origin.
struct Cell {
  int x = 0, y = 0;
  bool operator==(const Cell&) const = default;
};

/// The larger of the distances along x and y, in cells.
inline int ringDistance(const Cell& a, const Cell& b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)); }

/// Dense grid of values over a rectangle that grows on request, up to kMaxSide cells per side.
template <typename Value>
class Grid {
 public:
  static constexpr int kMaxSide = 512;

  explicit Grid(double cell_m) : cell_m_(cell_m) {}

  double cellSize() const { return cell_m_; }
  Cell cellAt(const mrpt::math::TPoint2D& p) const {
    return {static_cast<int>(std::floor(p.x / cell_m_)), static_cast<int>(std::floor(p.y / cell_m_))};
  }
  mrpt::math::TPoint2D center(const Cell& cell) const { return {(cell.x + 0.5) * cell_m_, (cell.y + 0.5) * cell_m_}; }

  std::size_t size() const { return values_.size(); }
  int columns() const { return columns_; }
  Cell low() const { return low_; }  ///< the first cell of all
  bool contains(const Cell& cell) const {
    return static_cast<unsigned>(cell.x - low_.x) < static_cast<unsigned>(columns_) &&
           static_cast<unsigned>(cell.y - low_.y) < static_cast<unsigned>(rows_);
  }
  std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell.y - low_.y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.x - low_.x);
  }
  Cell cell(std::size_t index) const {
    const auto i = static_cast<int>(index);
    return {low_.x + i % columns_, low_.y + i / columns_};
  }
  Value& operator[](const Cell& cell) { return values_[index(cell)]; }
  const Value& operator[](const Cell& cell) const { return values_[index(cell)]; }
  Value& at(std::size_t index) { return values_[index]; }
  const Value& at(std::size_t index) const { return values_[index]; }

  /// Extends the grid to contain the cells from `from` to `to`, as far as kMaxSide allows. New cells get a default
  /// Value. Grows geometrically; each growth invalidates all indices.
  void cover(const Cell& from, const Cell& to) {
    if (contains(from) && contains(to)) return;
    const Cell old_low = low_;
    const int old_columns = columns_, old_rows = rows_;
    int end_x = low_.x + columns_, end_y = low_.y + rows_;
    if (values_.empty()) {
      low_ = from;
      end_x = to.x + 1;
      end_y = to.y + 1;
    } else {
      grow(from.x, to.x, low_.x, end_x);
      grow(from.y, to.y, low_.y, end_y);
    }
    columns_ = end_x - low_.x;
    rows_ = end_y - low_.y;
    if (columns_ == old_columns && rows_ == old_rows) return;
    std::vector<Value> grown(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int y = 0; y < old_rows; ++y) {
      const auto from_row = values_.begin() + std::ptrdiff_t{y} * old_columns;
      std::copy_n(from_row, old_columns,
                  grown.begin() + static_cast<std::ptrdiff_t>(index({old_low.x, old_low.y + y})));
    }
    values_.swap(grown);
  }

  /// Resets all cells to default Values. A grid of maximum size drops its cells; the next cover() starts a new one.
  void reset() {
    if (std::max(columns_, rows_) == kMaxSide) {
      values_.clear();
      columns_ = rows_ = 0;
    }
    std::fill(values_.begin(), values_.end(), Value{});
  }

 private:
  /// Extends [low, end) to contain [from, to], by at least its own size on each extended side.
  static void grow(int from, int to, int& low, int& end) {
    const int piece = std::max(32, (end - low) / 2);
    if (from < low) low = std::max(std::min(from, low - piece), std::min(low, end - kMaxSide));
    if (to >= end) end = std::min(std::max(to + 1, end + piece), std::max(end, low + kMaxSide));
  }

  double cell_m_;
  Cell low_;
  int columns_ = 0, rows_ = 0;
  std::vector<Value> values_;
};

}  // namespace robosim
