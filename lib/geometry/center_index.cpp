#include "geometry/center_index.h"

namespace robosim {

CenterIndex::CenterIndex(const Bounds2D& area, double cell_m, std::size_t solids)
    : area_(area),
      cell_m_(cell_m),
      per_m_(1 / cell_m),
      columns_(cellsIn(area.x_max - area.x_min, cell_m)),
      rows_(cellsIn(area.y_max - area.y_min, cell_m)),
      begin_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0),
      items_(solids),
      cell_(solids),
      entries_(solids) {
  for (std::size_t i = 0; i < solids; ++i) items_[i].number = static_cast<std::uint32_t>(i);
}

void CenterIndex::build() {
  std::fill(begin_.begin(), begin_.end(), 0);
  reach_max_m_ = 0;
  centers_ = {kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const GridItem& item = items_[i];
    reach_max_m_ = std::max(reach_max_m_, item.reach());
    centers_ = {std::min(centers_.x_min, item.x), std::max(centers_.x_max, item.x), std::min(centers_.y_min, item.y),
                std::max(centers_.y_max, item.y)};
    cell_[i] = static_cast<std::uint32_t>(cellAt(row(item.y), column(item.x)));
    ++begin_[cell_[i]];
  }
  std::uint32_t sum = 0;
  for (auto& begin : begin_) begin = sum += begin;  // each cell's end, for now
  // Filled from the back, so that each cell's end becomes its begin and its solids stay in the order given.
  for (std::size_t i = items_.size(); i-- > 0;) {
    entries_[--begin_[cell_[i]]] = {RoughSolid::from(items_[i], middle()), static_cast<std::uint32_t>(i)};
  }
}

}  // namespace robosim
