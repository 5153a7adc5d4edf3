#include "world/raster.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <mrpt/core/format.h>

#include "base/error_list.h"
#include "base/portable_pose.h"
#include "base/xml_element.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// Minimum overlap [m] with a cell: rounding may put faces that touch a border on either side of it.
constexpr double kTouch_m = 1e-7;

struct Interval {
  double from, to;
};

/// Interval in x of an outline within a strip of y; nullopt when they do not intersect.
std::optional<Interval> within(const Circle& circle, const Interval& strip) {
  const double off = std::max({0.0, strip.from - circle.center.y, circle.center.y - strip.to});
  if (off >= circle.radius_m) return std::nullopt;
  const double half = std::sqrt(circle.radius_m * circle.radius_m - off * off);
  return Interval{circle.center.x - half, circle.center.x + half};
}

std::optional<Interval> within(const OrientedBox& box, const Interval& strip) {
  const TPoint2D along = box.axis * box.half_length_m;
  const TPoint2D across(-box.axis.y * box.half_width_m, box.axis.x * box.half_width_m);
  const TPoint2D corners[] = {box.center + along + across, box.center - along + across, box.center - along - across,
                              box.center + along - across};
  std::optional<Interval> found;
  const auto include = [&](double x) {
    found = found ? Interval{std::min(found->from, x), std::max(found->to, x)} : Interval{x, x};
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const TPoint2D &a = corners[i], &b = corners[(i + 1) % 4];
    if (strip.from <= a.y && a.y <= strip.to) include(a.x);
    for (const double y : {strip.from, strip.to}) {
      if ((a.y < y) != (b.y < y)) include(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
  }
  return found;
}

/// Range of cell numbers, counted from the origin, that an interval overlaps by more than a touch; at least one cell.
struct Cells {
  std::int64_t first, last;

  Cells(Interval interval, double cell_m) {
    if (interval.to - interval.from < 2 * kTouch_m) {
      interval.from = interval.to = (interval.from + interval.to) / 2;
    } else {
      interval = {interval.from + kTouch_m, interval.to - kTouch_m};
    }
    first = static_cast<std::int64_t>(std::floor(interval.from / cell_m));
    last = std::max(first, static_cast<std::int64_t>(std::ceil(interval.to / cell_m)) - 1);
  }
};

/// Occupancy grid addressed by cell numbers counted from the origin.
class Raster {
 public:
  /// @param origin point from which cells lie at multiples of their side
  Raster(const Bounds2D& in_world, double cell_m, const TPoint2D& origin) : Raster(moved(in_world, origin), cell_m) {
    origin_ = origin;
    grid_.map_from_grid.x += origin.x;
    grid_.map_from_grid.y += origin.y;
  }

  void fill(const Outline& in_world, Occupancy what) {
    const Outline outline = std::visit(
        [&](auto shape) -> Outline {
          shape.center -= origin_;
          return shape;
        },
        in_world);
    fillFromOrigin(outline, what);
  }

  OccupancyGrid finish() { return std::move(grid_); }

 private:
  static Bounds2D moved(const Bounds2D& area, const TPoint2D& origin) {
    return {area.x_min - origin.x, area.x_max - origin.x, area.y_min - origin.y, area.y_max - origin.y};
  }

  Raster(const Bounds2D& area, double cell_m)
      : cell_m_(cell_m), columns_({area.x_min, area.x_max}, cell_m), rows_({area.y_min, area.y_max}, cell_m) {
    const auto columns = static_cast<double>(columns_.last - columns_.first + 1);
    const auto rows = static_cast<double>(rows_.last - rows_.first + 1);
    if (columns * rows > static_cast<double>(kMaxMapCells)) {
      throw ConfigError("cells of " + toText(cell_m) + " m make a grid of " +
                        mrpt::format("%.0f × %.0f", columns, rows) + "; a map may have " +
                        std::to_string(kMaxMapCells) + " at most, so make them larger");
    }
    grid_.columns = static_cast<std::uint32_t>(columns);
    grid_.rows = static_cast<std::uint32_t>(rows);
    grid_.cell_m = cell_m;
    grid_.map_from_grid = {static_cast<double>(columns_.first) * cell_m, static_cast<double>(rows_.first) * cell_m, 0};
    grid_.cells.assign(std::size_t{grid_.columns} * grid_.rows, Occupancy::unknown);
  }

  void fillFromOrigin(const Outline& outline, Occupancy what) {
    const Bounds2D b = boundsOf(outline);
    const Cells rows({b.y_min, b.y_max}, cell_m_);
    for (std::int64_t row = rows.first; row <= rows.last; ++row) {
      // The strip of the row, reduced by the touch tolerance; or a line where a thin outline lies.
      const double middle = std::clamp((b.y_min + b.y_max) / 2, static_cast<double>(row) * cell_m_,
                                       static_cast<double>(row + 1) * cell_m_);
      const Interval strip{std::min(static_cast<double>(row) * cell_m_ + kTouch_m, middle),
                           std::max(static_cast<double>(row + 1) * cell_m_ - kTouch_m, middle)};
      const auto x = std::visit([&](const auto& shape) { return within(shape, strip); }, outline);
      if (x) fillRow(row, Cells(*x, cell_m_), what);
    }
  }

  void fillRow(std::int64_t row, const Cells& cells, Occupancy what) {
    if (row < rows_.first || row > rows_.last) return;
    const auto begin = std::max(cells.first, columns_.first) - columns_.first;
    const auto end = std::min(cells.last, columns_.last) - columns_.first + 1;
    const auto first = grid_.cells.begin() + (row - rows_.first) * static_cast<std::int64_t>(grid_.columns);
    if (begin < end) std::fill(first + begin, first + end, what);
  }

  TPoint2D origin_{0, 0};
  double cell_m_;
  Cells columns_, rows_;
  OccupancyGrid grid_;
};

}  // namespace

HeightSpan robotHeights(const std::vector<HeightSpan>& robots) {
  if (robots.empty()) return {0, 1};
  HeightSpan all = robots.front();
  for (const auto& heights : robots) {
    all = {std::min(all.z_min_m, heights.z_min_m), std::max(all.z_max_m, heights.z_max_m)};
  }
  return all;
}

HeightSpan heightsOfAll(const World& world) {
  HeightSpan all{0, 0};
  const auto include = [&](const HeightSpan& heights) {
    all = {std::min(all.z_min_m, heights.z_min_m), std::max(all.z_max_m, heights.z_max_m)};
  };
  for (const auto& object : world.objects) include(object.body.heights());
  for (const auto& map : world.maps) include(map.heights());
  return all.z_max_m > 0 ? all : HeightSpan{all.z_min_m, 1};
}

std::optional<MapExtent> extentOfMap(const World& world) {
  for (const auto& map : world.maps) {
    const mrpt::math::TPose2D corner = portable::compose(map.world_from_map, map.plan.map_from_grid);
    if (map.plan.columns == 0 || corner.phi != 0 || map.isFloor()) continue;
    return MapExtent{.cell_m = map.plan.cell_m, .heights = {}, .origin = {corner.x, corner.y}};
  }
  return std::nullopt;
}

OccupancyGrid rasterize(const World& world, const MapExtent& extent) {
  std::vector<Solid> solids = startSolids(world);
  const HeightSpan heights{extent.heights.z_min_m + kTouch_m, extent.heights.z_max_m - kTouch_m};
  std::erase_if(solids, [&](const Solid& solid) { return !solid.heights.overlaps(heights); });
  Bounds2D area = world.bounds;
  for (const auto& solid : solids) {
    const Bounds2D b = boundsOf(solid.outline);
    area = {std::min(area.x_min, b.x_min), std::max(area.x_max, b.x_max), std::min(area.y_min, b.y_min),
            std::max(area.y_max, b.y_max)};
  }
  Raster raster(area, extent.cell_m, extent.origin);
  const Bounds2D& surface = world.bounds;
  const mrpt::math::TPose2D middle{(surface.x_min + surface.x_max) / 2, (surface.y_min + surface.y_max) / 2, 0};
  raster.fill(OrientedBox::from(middle, surface.x_max - surface.x_min, surface.y_max - surface.y_min), Occupancy::free);
  for (const auto& map : world.maps) {
    for (const auto& solid : unknownSolids(map)) raster.fill(solid.outline, Occupancy::unknown);
  }
  for (const auto& solid : solids) raster.fill(solid.outline, Occupancy::occupied);
  return raster.finish();
}

}  // namespace robosim
