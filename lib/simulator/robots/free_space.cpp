#include "robots/free_space.h"

#include <algorithm>
#include <cmath>

#include "base/error_list.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

double cellsOf(const Bounds2D& bounds, double radius_m) {
  return 4 * (bounds.x_max - bounds.x_min) / radius_m * ((bounds.y_max - bounds.y_min) / radius_m);
}

const Bounds2D& checkedSize(const World& world, double radius_m) {
  if (cellsOf(world.bounds, radius_m) < 1e8) return world.bounds;
  throw ConfigError("world '" + world.name +
                    "': is too large to search for free positions; keep its sides below 5,000 robot radii");
}

}  // namespace

FreeSpace::FreeSpace(const World& world, double radius_m, const HeightSpan& heights)
    : bounds_(checkedSize(world, radius_m)),
      radius_m_(radius_m),
      cell_m_(radius_m / 2),
      columns_(count(bounds_.x_max - bounds_.x_min)),
      rows_(count(bounds_.y_max - bounds_.y_min)),
      free_(columns_ * rows_, 1),
      left_closed_(rows_),
      right_closed_(rows_),
      bottom_closed_(columns_),
      top_closed_(columns_) {
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const TPoint2D p = place(i);
    const double to_rim =
        std::min({p.x - bounds_.x_min, bounds_.x_max - p.x, p.y - bounds_.y_min, bounds_.y_max - p.y});
    if (to_rim < radius_m) free_[i] = 0;
  }
  for (const auto& solid : startSolids(world)) {
    if (!solid.heights.overlaps(heights)) continue;
    block(solid.outline, radius_m);
    closeEdges(solid.outline);
  }
}

std::vector<std::size_t> FreeSpace::reachableFrom(const std::vector<TPoint2D>& starts) const {
  std::vector<std::uint8_t> seen(free_.size(), 0);
  std::vector<std::size_t> reached;
  for (const auto& start : starts) {
    const auto column = static_cast<std::ptrdiff_t>((start.x - bounds_.x_min) / cell_m_);
    const auto row = static_cast<std::ptrdiff_t>((start.y - bounds_.y_min) / cell_m_);
    for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(0, row - 1); y <= row + 1; ++y) {
      for (std::ptrdiff_t x = std::max<std::ptrdiff_t>(0, column - 1); x <= column + 1; ++x) {
        if (x >= static_cast<std::ptrdiff_t>(columns_) || y >= static_cast<std::ptrdiff_t>(rows_)) continue;
        const auto cell = static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
        if (!free_[cell] || seen[cell]) continue;
        seen[cell] = 1;
        reached.push_back(cell);
      }
    }
  }
  spread(seen, reached);
  std::sort(reached.begin(), reached.end());
  return reached;
}

std::vector<std::size_t> FreeSpace::largestRegion() const {
  std::vector<std::uint8_t> seen(free_.size(), 0);
  std::vector<std::size_t> largest, region;
  for (std::size_t i = 0; i < free_.size(); ++i) {
    if (!free_[i] || seen[i]) continue;
    seen[i] = 1;
    region.assign(1, i);
    spread(seen, region);
    if (region.size() > largest.size()) largest.swap(region);
  }
  std::sort(largest.begin(), largest.end());
  return largest;
}

void FreeSpace::blockUnknown(const World& world) {
  for (const auto& map : world.maps) {
    for (const auto& solid : unknownSolids(map)) block(solid.outline, 0);
  }
}

void FreeSpace::blockOutside(const Bounds2D& region) {
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const TPoint2D p = place(i);
    if (p.x < region.x_min || p.x > region.x_max || p.y < region.y_min || p.y > region.y_max) free_[i] = 0;
  }
}

double FreeSpace::openEdge(const std::vector<std::size_t>& cells) const {
  // A cell is at an edge when its neighbour towards the edge would be within the disc's radius of it.
  const double near_m = radius_m_ + cell_m_;
  std::size_t at_edge = 0;
  for (const auto cell : cells) {
    const TPoint2D p = place(cell);
    const std::size_t column = cell % columns_, row = cell / columns_;
    if (p.x - bounds_.x_min < near_m && !left_closed_[row]) ++at_edge;
    if (bounds_.x_max - p.x < near_m && !right_closed_[row]) ++at_edge;
    if (p.y - bounds_.y_min < near_m && !bottom_closed_[column]) ++at_edge;
    if (bounds_.y_max - p.y < near_m && !top_closed_[column]) ++at_edge;
  }
  return static_cast<double>(at_edge) * cell_m_;
}

/// Marks where a disc pushed against an edge touches the outline.
void FreeSpace::closeEdges(const Outline& outline) {
  constexpr double kBehind_m = 0.01;
  const double reach_m = radius_m_ + kBehind_m;
  const Bounds2D b = boundsOf(outline);
  const auto index = [&](double at, double low, std::size_t n) {
    return static_cast<std::size_t>(std::clamp((at - low) / cell_m_, 0.0, static_cast<double>(n - 1)));
  };
  const auto close = [&](std::vector<std::uint8_t>& closed, double from, double to, double low, const auto& center) {
    const std::size_t last = index(to + reach_m, low, closed.size());
    for (std::size_t i = index(from - reach_m, low, closed.size()); i <= last; ++i) {
      const double along = low + (static_cast<double>(i) + 0.5) * cell_m_;
      if (distance(outline, center(along)) <= reach_m) closed[i] = 1;
    }
  };
  const double left = bounds_.x_min + radius_m_, right = bounds_.x_max - radius_m_;
  const double bottom = bounds_.y_min + radius_m_, top = bounds_.y_max - radius_m_;
  const double x = bounds_.x_min, y = bounds_.y_min;
  if (b.x_min <= left + reach_m)
    close(left_closed_, b.y_min, b.y_max, y, [&](double at) { return TPoint2D(left, at); });
  if (b.x_max >= right - reach_m) {
    close(right_closed_, b.y_min, b.y_max, y, [&](double at) { return TPoint2D(right, at); });
  }
  if (b.y_min <= bottom + reach_m) {
    close(bottom_closed_, b.x_min, b.x_max, x, [&](double at) { return TPoint2D(at, bottom); });
  }
  if (b.y_max >= top - reach_m) close(top_closed_, b.x_min, b.x_max, x, [&](double at) { return TPoint2D(at, top); });
}

void FreeSpace::spread(std::vector<std::uint8_t>& seen, std::vector<std::size_t>& reached) const {
  const auto visit = [&](std::size_t cell) {
    if (!free_[cell] || seen[cell]) return;
    seen[cell] = 1;
    reached.push_back(cell);
  };
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::size_t cell = reached[next];
    const std::size_t column = cell % columns_, row = cell / columns_;
    if (column > 0) visit(cell - 1);
    if (column + 1 < columns_) visit(cell + 1);
    if (row > 0) visit(cell - columns_);
    if (row + 1 < rows_) visit(cell + columns_);
  }
}

std::size_t FreeSpace::count(double extent_m) const {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(extent_m / cell_m_)));
}

void FreeSpace::block(const Outline& outline, double radius_m) {
  const Bounds2D b = boundsOf(outline);
  const auto index = [&](double at, double low, std::size_t n) {
    return static_cast<std::size_t>(std::clamp((at - low) / cell_m_, 0.0, static_cast<double>(n - 1)));
  };
  const std::size_t right = index(b.x_max + radius_m, bounds_.x_min, columns_);
  const std::size_t top = index(b.y_max + radius_m, bounds_.y_min, rows_);
  for (std::size_t row = index(b.y_min - radius_m, bounds_.y_min, rows_); row <= top; ++row) {
    for (std::size_t column = index(b.x_min - radius_m, bounds_.x_min, columns_); column <= right; ++column) {
      const std::size_t cell = row * columns_ + column;
      if (free_[cell] && distance(outline, place(cell)) <= radius_m) free_[cell] = 0;
    }
  }
}

}  // namespace robosim
