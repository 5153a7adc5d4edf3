#include "distributed/area_grid.h"

#include <algorithm>
#include <cmath>

#include "distributed/rank_bytes.h"

namespace robosim {

AreaGrid::AreaGrid(const Bounds2D& surface, double reach_m) : x_min_m_(surface.x_min), y_min_m_(surface.y_min) {
  const double width_m = surface.x_max - surface.x_min, length_m = surface.y_max - surface.y_min;
  cell_m_ = std::max(
      {reach_m / 2, std::sqrt(width_m * length_m / kCellsMax), width_m / kCellsMax, length_m / kCellsMax, 1e-3});
  columns_ = static_cast<std::uint32_t>(width_m / cell_m_) + 1;
  rows_ = static_cast<std::uint32_t>(length_m / cell_m_) + 1;
}

Area AreaGrid::around(std::span<const mrpt::math::TPose2D> poses, RobotRange robots, double reach_m) const {
  std::vector<std::uint8_t> is_within(cells());
  for (std::size_t i = robots.begin; i < robots.end; ++i) {
    const auto& pose = poses[i];
    const std::uint32_t left = column(pose.x - reach_m), right = column(pose.x + reach_m);
    const std::uint32_t top = row(pose.y + reach_m);
    for (std::uint32_t r = row(pose.y - reach_m); r <= top; ++r) {
      std::uint8_t* const cells_of_row = is_within.data() + std::size_t{r} * columns_;
      std::fill(cells_of_row + left, cells_of_row + right + 1, 1);
    }
  }
  Area area;
  for (auto at = is_within.begin(); at != is_within.end();) {
    const auto begin = std::find(at, is_within.end(), 1);
    if (begin == is_within.end()) break;
    at = std::find(begin, is_within.end(), 0);
    area.push_back(
        {static_cast<std::uint32_t>(begin - is_within.begin()), static_cast<std::uint32_t>(at - is_within.begin())});
  }
  return area;
}

void writeArea(const Area& area, std::string& out) {
  static_assert(sizeof(CellRange) == 2 * sizeof(std::uint32_t));
  out.append(reinterpret_cast<const char*>(area.data()), area.size() * sizeof(CellRange));
}

Area readArea(std::string_view bytes, std::uint32_t cells) {
  Area area;
  readRankBytes(bytes, "areas", [&](StateReader& in) {
    std::uint32_t end = 0;
    while (!in.isAtEnd()) {
      CellRange& range = area.emplace_back();
      range.begin = in.takeNumber<std::uint32_t>();
      range.end = in.takeNumber<std::uint32_t>();
      requireContents(range.begin >= end && range.begin < range.end && range.end <= cells, "a range of cells is wrong");
      end = range.end;
    }
  });
  return area;
}

void RobotsByCell::assign(std::span<const mrpt::math::TPose2D> poses, RobotRange robots) {
  std::fill(begin_.begin(), begin_.end(), 0);
  cell_.clear();
  for (std::size_t i = robots.begin; i < robots.end; ++i) ++begin_[cell_.emplace_back(grid_.cellAt(poses[i]))];
  std::uint32_t sum = 0;
  for (auto& begin : begin_) begin = sum += begin;  // each cell's end until the robots are filled in
  robots_.resize(cell_.size());
  for (std::size_t k = cell_.size(); k-- > 0;)
    robots_[--begin_[cell_[k]]] = static_cast<std::uint32_t>(robots.begin + k);
}

void RobotsByCell::addWithin(const Area& area, std::vector<std::uint32_t>& found) const {
  for (const CellRange& range : area) {
    found.insert(found.end(), robots_.begin() + begin_[range.begin], robots_.begin() + begin_[range.end]);
  }
}

}  // namespace robosim
