#include "geometry/grid_index.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

/// Solids are listed a little more widely than they reach, so that no rounding on a ray's way makes it miss a cell that
/// a solid touches with a corner.
constexpr double kMargin_m = 1e-6;

/// Whether the box reaches into the square cell, by the two axes of the box (those of the cell are covered by its
/// bounds).
bool reaches(const OrientedBox& box, const mrpt::math::TPoint2D& cell_center, double half_cell_m) {
  const auto between = cell_center - box.center;
  const double shadow = half_cell_m * (std::abs(box.axis.x) + std::abs(box.axis.y)) + kMargin_m;
  return std::abs(between.x * box.axis.x + between.y * box.axis.y) <= box.half_length_m + shadow &&
         std::abs(between.y * box.axis.x - between.x * box.axis.y) <= box.half_width_m + shadow;
}

int cells(double extent_m, double cell_m) {
  return static_cast<int>(std::clamp(std::ceil(extent_m / cell_m), 1.0, 32768.0));
}

}  // namespace

GridIndex::GridIndex(const Bounds2D& area, double cell_m)
    : area_(area),
      cell_m_(cell_m),
      per_m_(1 / cell_m),
      columns_(cells(area.x_max - area.x_min, cell_m)),
      rows_(cells(area.y_max - area.y_min, cell_m)),
      begin_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0) {}

int GridIndex::column(double x) const {
  return static_cast<int>(std::clamp(std::floor((x - area_.x_min) * per_m_), 0.0, columns_ - 1.0));
}

int GridIndex::row(double y) const {
  return static_cast<int>(std::clamp(std::floor((y - area_.y_min) * per_m_), 0.0, rows_ - 1.0));
}

template <typename Visit>
void GridIndex::forCells(const Solid& solid, const Visit& visit) const {
  const Bounds2D reach = boundsOf(solid.outline);
  const int left = column(reach.x_min - kMargin_m);
  const int right = column(reach.x_max + kMargin_m);
  const int bottom = row(reach.y_min - kMargin_m);
  const int top = row(reach.y_max + kMargin_m);
  const auto* box = std::get_if<OrientedBox>(&solid.outline);
  for (int y = bottom; y <= top; ++y) {
    for (int x = left; x <= right; ++x) {
      const bool on_rim = x == 0 || y == 0 || x == columns_ - 1 || y == rows_ - 1;
      const mrpt::math::TPoint2D center(area_.x_min + (x + 0.5) * cell_m_, area_.y_min + (y + 0.5) * cell_m_);
      if (!box || on_rim || reaches(*box, center, cell_m_ / 2)) {
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x));
      }
    }
  }
}

void GridIndex::build(std::span<const Solid> solids) {
  std::fill(begin_.begin(), begin_.end(), 0);
  for (const auto& solid : solids) forCells(solid, [&](std::size_t cell) { ++begin_[cell]; });
  std::uint32_t sum = 0;
  for (auto& begin : begin_) begin = sum += begin;  // each cell's end, for now
  items_.resize(sum);
  // Filled from the back, so that each cell's end becomes its begin and its solids stay in ascending order.
  for (std::size_t i = solids.size(); i-- > 0;) {
    forCells(solids[i], [&](std::size_t cell) { items_[--begin_[cell]] = static_cast<std::uint32_t>(i); });
  }
}

}  // namespace robosim
