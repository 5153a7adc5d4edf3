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
        const TPoint2D next = start_from_scanner.composePoint(*scan.point(i + 1));
        traverse(end, next, [&](Cell& cell) { addSurface(cell, end, next); });
      } else if (Cell* const cell = cellAt(indexOf(end))) {
        addPoint(*cell, end);
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

TPoint2D SurfaceGrid::centerOf(const Cell& cell) const {
  const auto index = static_cast<int>(&cell - cells_.data());
  return {(index % (2 * half_) - half_ + 0.5) * kCell_m, (index / (2 * half_) - half_ + 0.5) * kCell_m};
}

void SurfaceGrid::addPoint(Cell& cell, const TPoint2D& p) {
  ++cell.ends;
  const TPoint2D off = p - centerOf(cell);
  cell.x_m += static_cast<float>(off.x);
  cell.y_m += static_cast<float>(off.y);
}

/// Adds the point of a surface that is nearest to the middle of a cell, and the surface's direction.
void SurfaceGrid::addSurface(Cell& cell, const TPoint2D& from, const TPoint2D& to) {
  const TPoint2D along = to - from, out = centerOf(cell) - from;
  const double length_m2 = std::max(along.x * along.x + along.y * along.y, 1e-12);
  addPoint(cell, from + along * std::clamp((out.x * along.x + out.y * along.y) / length_m2, 0.0, 1.0));
  // A surface has no sense, so directions are added with twice their angle.
  cell.cos_2 += static_cast<float>((along.x * along.x - along.y * along.y) / length_m2);
  cell.sin_2 += static_cast<float>(2 * along.x * along.y / length_m2);
}

/// A thin box along the mean surface of a cell.
Solid SurfaceGrid::solidOf(const Cell& cell) const {
  constexpr double kLength_m = 1.5 * kCell_m, kDepth_m = 0.005;  // longer than a diagonal, so that no beam passes
  const TPoint2D middle = centerOf(cell) + TPoint2D(cell.x_m, cell.y_m) * (1.0 / cell.ends);
  return {OrientedBox::from({middle.x, middle.y, std::atan2(cell.sin_2, cell.cos_2) / 2}, kLength_m, kDepth_m),
          {0, kHeight_m}};
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
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (occupied[i]) solids.push_back(solidOf(cells_[i]));
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
