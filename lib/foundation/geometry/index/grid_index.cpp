#include "geometry/index/grid_index.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace robosim {
namespace {

/// Solids are listed with this margin, so that rounding along a ray never skips a cell that a solid touches with a
/// corner.
constexpr double kMargin_m = 1e-6;

/// Whether a box overlaps a square cell, by the separating axes of the box. The axes of the cell are covered by the
/// box's bounds.
bool reaches(const GridItem& box, double center_x, double center_y, double half_cell_m) {
  const double dx = center_x - box.x;
  const double dy = center_y - box.y;
  const double half_projection = half_cell_m * (std::abs(box.axis_x) + std::abs(box.axis_y)) + kMargin_m;
  return std::abs(dx * box.axis_x + dy * box.axis_y) <= box.half_length_m + half_projection &&
         std::abs(dy * box.axis_x - dx * box.axis_y) <= box.half_width_m + half_projection;
}

}  // namespace

int cellsIn(double extent_m, double cell_m) {
  const double cells = std::ceil(extent_m / cell_m);
  return cells > 1 ? static_cast<int>(std::min<double>(cells, kMaxCells)) : 1;  // also for NaN
}

GridIndex::GridIndex(const Bounds2D& area, double cell_m)
    : area_(area),
      cell_m_(cell_m),
      per_m_(1 / cell_m),
      columns_(cellsIn(area.x_max - area.x_min, cell_m)),
      rows_(cellsIn(area.y_max - area.y_min, cell_m)),
      middle_((area.x_min + area.x_max) / 2, (area.y_min + area.y_max) / 2),
      low_(area.x_min, area.y_min),
      cells_(columns_, rows_),
      packs_(cellCount()) {}

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
      if (item.isCircle() || in_one || isBorderCell(x, y) ||
          reaches(item, area_.x_min + (x + 0.5) * cell_m_, area_.y_min + (y + 0.5) * cell_m_, cell_m_ / 2)) {
        visit(cellAt(x, y));
      }
    }
  }
}

void GridIndex::sort(std::span<const Solid> solids) {
  const std::size_t count = solids.size();
  items_.resize(count);
  number_of_.resize(count);
  index_of_.resize(count);
  std::vector<std::uint32_t> begin(cellCount());
  for (std::size_t number = 0; number < count; ++number) {
    const auto cell = std::visit([&](const auto& shape) { return cellAt(column(shape.center.x), row(shape.center.y)); },
                                 solids[number].outline);
    index_of_[number] = static_cast<std::uint32_t>(cell);  // the cell until the items are placed
    ++begin[cell];
  }
  std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), 0U);
  for (std::size_t number = 0; number < count; ++number) {
    const std::uint32_t index = begin[index_of_[number]]++;
    items_[index] = GridItem::from(solids[number]);
    number_of_[index] = static_cast<std::uint32_t>(number);
    index_of_[number] = index;
  }
}

void GridIndex::build(std::span<const Solid> solids) {
  sort(solids);
  contains_all_ = true;
  std::vector<std::uint32_t> counts(cellCount());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    contains_all_ = contains_all_ && containsAll(items_[i]);
    forCells(items_[i], [&](std::size_t cell) { ++counts[cell]; });
  }
  allocatePacks(counts);
  std::vector<std::uint32_t> filled(cellCount());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const double margin_m = roundingError(items_[i]);
    const double reach_m = items_[i].reach() + margin_m;
    const CullDisc solid = CullDisc::from(items_[i], middle());
    forCells(items_[i], [&](std::size_t cell) {
      const std::size_t place = filled[cell]++;
      const std::size_t nth = std::min(place / CellPack::kSolidsBeforeLink, CellPack::packCount(counts[cell]) - 1);
      // The linked packs of a cell are contiguous.
      const std::size_t pack = nth == 0 ? cell : packs_[cell].next() + nth - 1;
      const std::size_t in_pack = place - nth * CellPack::kSolidsBeforeLink;
      packs_[pack].set(in_pack, solid, reach_m, static_cast<std::uint32_t>(i));
      if (!rectangles_.empty()) rectangles_[pack].set(in_pack, items_[i], margin_m);
    });
  }
}

void GridIndex::allocatePacks(const std::vector<std::uint32_t>& counts) {
  packs_.clear();
  packs_.reserve(std::transform_reduce(counts.begin(), counts.end(), std::size_t{0}, std::plus(), CellPack::packCount));
  packs_.resize(cellCount());
  for (std::size_t cell = 0; cell < cellCount(); ++cell) {
    std::size_t pack = cell;
    for (std::size_t more = CellPack::packCount(counts[cell]); more > 1; --more) {
      packs_[pack].linkTo(static_cast<std::uint32_t>(packs_.size()));
      pack = packs_.size();
      packs_.emplace_back();
    }
  }
  rectangles_.assign(areManyElongated() ? packs_.size() : 0, CellRectangles());
}

double GridIndex::borderMargin(double cell_m) {
  constexpr double kCells = 1.0 / (1 << 20);  // GridTraversal ends 2^-24 of a cell before the border
  return kMargin_m + kCells * cell_m;
}

bool GridIndex::containsAll(const GridItem& item) const {
  const double margin_m = borderMargin(cell_m_);
  const Bounds2D bounds = item.bounds();
  return bounds.x_min >= area_.x_min + margin_m && bounds.x_max <= area_.x_min + columns_ * cell_m_ - margin_m &&
         bounds.y_min >= area_.y_min + margin_m && bounds.y_max <= area_.y_min + rows_ * cell_m_ - margin_m;
}

bool GridIndex::areManyElongated() const {
  constexpr double kLong = 3;  // ratio of length to width
  const auto are_long = std::count_if(items_.begin(), items_.end(), [](const GridItem& item) {
    return !item.isCircle() &&
           std::max(item.half_length_m, item.half_width_m) > kLong * std::min(item.half_length_m, item.half_width_m);
  });
  return 4 * static_cast<std::size_t>(are_long) > items_.size();
}

double GridIndex::roundingError(const GridItem& item) const {
  const double far_m =
      std::abs(item.x - middle().x) + std::abs(item.y - middle().y) + item.reach() + cell_m_ * (columns_ + rows_);
  return kCullRelativeError * far_m + kMargin_m;
}

}  // namespace robosim
