#include "tests/slam_errors/surface_grid.h"

#include <algorithm>
#include <cmath>

#include "tests/slam_errors/surface_scan.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kHalf_m = 60;  ///< surfaces that are farther from the start are left out
constexpr double kHeight_m = 2;

}  // namespace

SurfaceGrid::SurfaceGrid(const ScanSeries& series, const std::vector<TPose2D>& start_from_robot)
    : half_(static_cast<int>(kHalf_m / kCell_m)), cells_(static_cast<std::size_t>(4 * half_ * half_)) {
  for (std::size_t k = 0; k < series.scans.size(); ++k) {
    const SurfaceScan scan(series, series.scans[k].ranges_m);
    const TPose2D start_from_scanner = start_from_robot[k] + series.robot_from_scanner;
    const TPoint2D origin(start_from_scanner.x, start_from_scanner.y);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const auto point = scan.point(i);
      if (!point) continue;
      const TPoint2D end = start_from_scanner.composePoint(*point);
      traverse(origin, end, [](Cell& cell) { ++cell.passes; });
      if (scan.isJoined(i)) {
        traverse(end, start_from_scanner.composePoint(*scan.point(i + 1)), [](Cell& cell) { ++cell.ends; });
      } else if (Cell* const cell = cellAt(indexOf(end))) {
        ++cell->ends;
      }
    }
  }
}

SurfaceGrid::Index SurfaceGrid::indexOf(const TPoint2D& p) const {
  return {static_cast<int>(std::floor(p.x / kCell_m)) + half_, static_cast<int>(std::floor(p.y / kCell_m)) + half_};
}

SurfaceGrid::Cell* SurfaceGrid::cellAt(const Index& index) {
  if (index.x < 0 || index.y < 0 || index.x >= 2 * half_ || index.y >= 2 * half_) return nullptr;
  return &cells_[static_cast<std::size_t>(index.y * 2 * half_ + index.x)];
}

bool SurfaceGrid::isOccupied(const Cell& cell) const {
  constexpr int kFewestEnds = 2, kShare = 4;  // a quarter of the beams
  return cell.ends >= kFewestEnds && kShare * cell.ends >= cell.ends + cell.passes;
}

/// Visits the cells from one point to shortly before another, each once, at points half a cell apart.
template <typename Visit>
void SurfaceGrid::traverse(const TPoint2D& from, const TPoint2D& to, const Visit& visit) {
  const TPoint2D along = to - from;
  const int steps = static_cast<int>(std::ceil(along.norm() / (kCell_m / 2)));
  const Cell* last = nullptr;
  const Cell* const end = cellAt(indexOf(to));
  for (int step = 0; step < steps; ++step) {
    Cell* const cell = cellAt(indexOf(from + along * (static_cast<double>(step) / steps)));
    if (cell && cell != last && cell != end) visit(*cell);
    last = cell;
  }
}

std::vector<Solid> SurfaceGrid::solids(const std::vector<TPose2D>& path, double clear_m) const {
  std::vector<char> occupied;
  for (const auto& cell : cells_) occupied.push_back(isOccupied(cell));
  const int clear = static_cast<int>(std::ceil(clear_m / kCell_m));
  for (const auto& pose : path) {
    const Index at = indexOf({pose.x, pose.y});
    for (int y = std::max(0, at.y - clear); y <= std::min(2 * half_ - 1, at.y + clear); ++y) {
      for (int x = std::max(0, at.x - clear); x <= std::min(2 * half_ - 1, at.x + clear); ++x) {
        if (std::hypot(x - at.x, y - at.y) <= clear) occupied[static_cast<std::size_t>(y * 2 * half_ + x)] = false;
      }
    }
  }
  std::vector<Solid> solids;
  for (int y = 0; y < 2 * half_; ++y) {
    const char* const row = &occupied[static_cast<std::size_t>(y * 2 * half_)];
    for (int x = 0; x < 2 * half_; ++x) {
      const int from = x;
      while (x < 2 * half_ && row[x]) ++x;
      if (x == from) continue;
      const double length_m = (x - from) * kCell_m;
      const TPose2D middle((from - half_) * kCell_m + length_m / 2, (y - half_ + 0.5) * kCell_m, 0);
      solids.push_back({OrientedBox::from(middle, length_m, kCell_m), {0, kHeight_m}});
    }
  }
  return solids;
}

mrpt::maps::COccupancyGridMap2D SurfaceGrid::gridmap() const {
  const auto side_m = static_cast<float>(kHalf_m);
  mrpt::maps::COccupancyGridMap2D map(-side_m, side_m, -side_m, side_m, static_cast<float>(kCell_m));
  for (int y = 0; y < 2 * half_; ++y) {
    for (int x = 0; x < 2 * half_; ++x) {
      const Cell& cell = cells_[static_cast<std::size_t>(y * 2 * half_ + x)];
      if (cell.ends + cell.passes == 0) continue;
      map.setCell(x, y, isOccupied(cell) ? 0.05f : 0.95f);
    }
  }
  return map;
}

}  // namespace robosim
