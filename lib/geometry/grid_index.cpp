#include "geometry/grid_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace robosim {
namespace {

/// Solids are listed a little more widely than they reach, so that no rounding on a ray's way makes it miss a cell that
/// a solid touches with a corner.
constexpr double kMargin_m = 1e-6;

/// Whether the box reaches into the square cell, by the two axes of the box (those of the cell are covered by its
/// bounds).
bool reaches(const GridItem& box, double center_x, double center_y, double half_cell_m) {
  const double dx = center_x - box.x;
  const double dy = center_y - box.y;
  const double shadow = half_cell_m * (std::abs(box.axis_x) + std::abs(box.axis_y)) + kMargin_m;
  return std::abs(dx * box.axis_x + dy * box.axis_y) <= box.half_length_m + shadow &&
         std::abs(dy * box.axis_x - dx * box.axis_y) <= box.half_width_m + shadow;
}

}  // namespace

int cellsIn(double extent_m, double cell_m) {
  return static_cast<int>(std::clamp(std::ceil(extent_m / cell_m), 1.0, 32768.0));
}

GridIndex::GridIndex(const Bounds2D& area, double cell_m)
    : area_(area),
      cell_m_(cell_m),
      per_m_(1 / cell_m),
      columns_(cellsIn(area.x_max - area.x_min, cell_m)),
      rows_(cellsIn(area.y_max - area.y_min, cell_m)),
      count_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0),
      begin_(count_.size() + 1, 0),
      packs_(1) {}

template <typename Visit>
void GridIndex::forCells(const GridItem& item, const Visit& visit) const {
  const Bounds2D bounds = item.bounds();
  const int left = column(bounds.x_min - kMargin_m);
  const int right = column(bounds.x_max + kMargin_m);
  const int bottom = row(bounds.y_min - kMargin_m);
  const int top = row(bounds.y_max + kMargin_m);
  const bool in_one = left == right && bottom == top;
  for (int y = bottom; y <= top; ++y) {
    for (int x = left; x <= right; ++x) {
      if (item.isCircle() || in_one || isOnRim(x, y) ||
          reaches(item, area_.x_min + (x + 0.5) * cell_m_, area_.y_min + (y + 0.5) * cell_m_, cell_m_ / 2)) {
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x));
      }
    }
  }
}

void GridIndex::sort(std::span<const Solid> solids) {
  const std::size_t count = solids.size();
  items_.resize(count);
  index_of_.resize(count);
  std::fill(begin_.begin(), begin_.end(), 0);
  for (std::size_t number = 0; number < count; ++number) {
    const auto cell = std::visit([&](const auto& shape) { return cellAt(column(shape.center.x), row(shape.center.y)); },
                                 solids[number].outline);
    index_of_[number] = static_cast<std::uint32_t>(cell);  // for now
    ++begin_[cell];
  }
  std::uint32_t sum = 0;
  for (auto& begin : begin_) sum += std::exchange(begin, sum);
  for (std::size_t number = 0; number < count; ++number) {
    const std::uint32_t index = begin_[index_of_[number]]++;
    items_[index] = GridItem::from(solids[number], static_cast<std::uint32_t>(number));
    index_of_[number] = index;
  }
}

void GridIndex::build(std::span<const Solid> solids) {
  sort(solids);
  rough_.resize(solids.size());
  std::fill(count_.begin(), count_.end(), 0);
  for (std::size_t i = 0; i < items_.size(); ++i) {
    rough_[i] = RoughSolid::from(items_[i], middle());
    forCells(items_[i], [&](std::size_t cell) { ++count_[cell]; });
  }
  begin_[0] = 0;
  for (std::size_t cell = 0; cell < count_.size(); ++cell) {
    begin_[cell + 1] = begin_[cell] + (count_[cell] + Pack::kMost - 1) / Pack::kMost;
  }
  packs_.assign(begin_.back() + 1, Pack());  // one more: who walks looks at a pack in an empty cell, too
  std::fill(count_.begin(), count_.end(), 0);
  for (std::size_t i = 0; i < items_.size(); ++i) {
    forCells(items_[i], [&](std::size_t cell) {
      packs_[begin_[cell] + count_[cell]++ / Pack::kMost].add(rough_[i], static_cast<std::uint32_t>(i));
    });
  }
}

}  // namespace robosim
