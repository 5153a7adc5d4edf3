#include "geometry/index/center_index.h"

namespace robosim {
namespace {

constexpr double kCellMin_m = 0.25;
/// Added to the number of solids, so that a few solids still get several cells.
constexpr double kExtraCells = 4;

/// Interval that contains most of a set of numbers: the mean ± twice the mean absolute deviation, clipped to the
/// minimum and maximum. It covers uniformly distributed numbers; a few outliers hardly widen it.
struct Spread {
  double min, max;

  static Spread of(double mean, double deviation, double min, double max) {
    return {std::max(min, mean - 2 * deviation), std::min(max, mean + 2 * deviation)};
  }
  double extent() const { return max - min; }
};

}  // namespace

CenterIndex::CenterIndex(std::size_t solids, const mrpt::math::TPoint2D& middle)
    : middle_(middle), items_(solids), cell_(solids), entries_(solids) {
  // Upper bound of the cells that chooseCells() makes: (w / cell + 1)·(h / cell + 1), and the end.
  begin_.reserve(3 * (solids + static_cast<std::size_t>(kExtraCells)) + 2);
}

void CenterIndex::chooseCells() {
  centers_ = {kInfinity, -kInfinity, kInfinity, -kInfinity};
  reach_max_m_ = 0;
  double sum_x = 0, sum_y = 0;
  std::size_t solids = 0;
  for (const GridItem& item : items_) {
    if (item.isRemoved()) continue;
    ++solids;
    reach_max_m_ = std::max(reach_max_m_, item.reach());
    centers_ = {std::min(centers_.x_min, item.x), std::max(centers_.x_max, item.x), std::min(centers_.y_min, item.y),
                std::max(centers_.y_max, item.y)};
    sum_x += item.x;
    sum_y += item.y;
  }
  if (solids == 0) return;
  const auto count = static_cast<double>(solids);
  const double mean_x = sum_x / count, mean_y = sum_y / count;
  double off_x = 0, off_y = 0;
  for (const GridItem& item : items_) {
    if (item.isRemoved()) continue;
    off_x += std::abs(item.x - mean_x);
    off_y += std::abs(item.y - mean_y);
  }
  const Spread x = Spread::of(mean_x, off_x / count, centers_.x_min, centers_.x_max);
  const Spread y = Spread::of(mean_y, off_y / count, centers_.y_min, centers_.y_max);
  area_ = {x.min, x.max, y.min, y.max};
  // One solid per cell, and no more columns or rows than solids when all stand in a line.
  const double cells = count + kExtraCells;
  cell_m_ = std::max({kCellMin_m, std::sqrt(x.extent() * y.extent() / cells), x.extent() / cells, y.extent() / cells});
  per_m_ = 1 / cell_m_;
  columns_ = cellsIn(x.extent(), cell_m_);
  rows_ = cellsIn(y.extent(), cell_m_);
}

void CenterIndex::build() {
  chooseCells();
  begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const GridItem& item = items_[i];
    if (item.isRemoved()) continue;
    cell_[i] = static_cast<std::uint32_t>(cellAt(row(item.y), column(item.x)));
    ++begin_[cell_[i]];
  }
  std::uint32_t sum = 0;
  for (auto& begin : begin_) begin = sum += begin;  // each cell's end until the entries are filled in
  // Filled from the back, so that each cell's end becomes its begin and its solids keep the order given.
  for (std::size_t i = items_.size(); i-- > 0;) {
    if (items_[i].isRemoved()) continue;
    entries_[--begin_[cell_[i]]] = {CullDisc::from(items_[i], middle()), static_cast<std::uint32_t>(i)};
  }
}

}  // namespace robosim
