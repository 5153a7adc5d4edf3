#include "distributed/area_grid.h"

#include <algorithm>
#include <cmath>

#include "distributed/rank_bytes.h"

namespace robosim {

namespace {

/// Robots may have 16 m² each, and cells a quarter of that.
constexpr double kCellsPerRobot = 4;
constexpr double kCellsMin = 65536;

}  // namespace

AreaGrid::AreaGrid(const Bounds2D& surface, std::size_t robots, double reach_m)
    : x_min_m_(surface.x_min), y_min_m_(surface.y_min) {
  const double width_m = surface.x_max - surface.x_min, length_m = surface.y_max - surface.y_min;
  const double cells_max = std::max(kCellsMin, kCellsPerRobot * static_cast<double>(robots));
  cell_m_ = std::max(
      {reach_m / 2, std::sqrt(width_m * length_m / cells_max), width_m / cells_max, length_m / cells_max, 1e-3});
  columns_ = static_cast<std::uint32_t>(width_m / cell_m_) + 1;
  rows_ = static_cast<std::uint32_t>(length_m / cell_m_) + 1;
}

Area AreaGrid::around(std::span<const mrpt::math::TPose2D> poses, RobotRange robots, double reach_m) const {
  if (robots.empty()) return {};
  // Of the rows that the area has cells in.
  std::uint32_t bottom = rows_, top = 0;
  for (std::size_t i = robots.begin; i < robots.end; ++i) {
    bottom = std::min(bottom, row(poses[i].y - reach_m));
    top = std::max(top, row(poses[i].y + reach_m));
  }
  std::vector<std::uint8_t> is_within(std::size_t{top - bottom + 1} * columns_);
  for (std::size_t i = robots.begin; i < robots.end; ++i) {
    const auto& pose = poses[i];
    const std::uint32_t left = column(pose.x - reach_m), right = column(pose.x + reach_m);
    const std::uint32_t last = row(pose.y + reach_m);
    for (std::uint32_t r = row(pose.y - reach_m); r <= last; ++r) {
      std::uint8_t* const cells_of_row = is_within.data() + std::size_t{r - bottom} * columns_;
      std::fill(cells_of_row + left, cells_of_row + right + 1, 1);
    }
  }
  const std::uint32_t first = bottom * columns_;
  Area area;
  for (auto at = is_within.begin(); at != is_within.end();) {
    const auto begin = std::find(at, is_within.end(), 1);
    if (begin == is_within.end()) break;
    at = std::find(begin, is_within.end(), 0);
    area.push_back({first + static_cast<std::uint32_t>(begin - is_within.begin()),
                    first + static_cast<std::uint32_t>(at - is_within.begin())});
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
  cell_.clear();
  cells_ = {robots.empty() ? 0 : grid_.cells(), 0};
  for (std::size_t i = robots.begin; i < robots.end; ++i) {
    const std::uint32_t cell = cell_.emplace_back(grid_.cellAt(poses[i]));
    cells_ = {std::min(cells_.begin, cell), std::max(cells_.end, cell + 1)};
  }
  begin_.assign(cells_.end - cells_.begin + 1, 0);
  for (const std::uint32_t cell : cell_) ++begin_[cell - cells_.begin];
  std::uint32_t sum = 0;
  for (auto& begin : begin_) begin = sum += begin;  // each cell's end until the robots are filled in
  robots_.resize(cell_.size());
  for (std::size_t k = cell_.size(); k-- > 0;)
    robots_[--begin_[cell_[k] - cells_.begin]] = static_cast<std::uint32_t>(robots.begin + k);
}

void RobotsByCell::addWithin(const Area& area, std::vector<std::uint32_t>& found) const {
  for (const CellRange& range : area) {
    const std::uint32_t begin = std::max(range.begin, cells_.begin), end = std::min(range.end, cells_.end);
    if (begin >= end) continue;
    found.insert(found.end(), robots_.begin() + begin_[begin - cells_.begin],
                 robots_.begin() + begin_[end - cells_.begin]);
  }
}

}  // namespace robosim
