#include "geometry/scene.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A cell size at which a cell holds less than one solid on average, and that keeps the grid's memory in proportion.
double cellFor(const Bounds2D& area, std::size_t solids) {
  const double square_m2 = std::max(1e-6, (area.x_max - area.x_min) * (area.y_max - area.y_min));
  return std::max(0.25, std::sqrt(square_m2 / (4.0 * static_cast<double>(solids + 4))));
}

bool better(double distance_m, BodyId body, const Hit& best) {
  return distance_m < best.distance_m || (distance_m == best.distance_m && best.body != kNoBody && body < best.body);
}

/// Visits the cells that the ray goes through, in its order, until the next one begins at or beyond reach() (Amanatides
/// & Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987). Cells on the rim go on outwards
/// without end.
template <typename Reach, typename Visit>
void alongRay(const GridIndex& grid, const Ray& ray, const Reach& reach, const Visit& visit) {
  struct Axis {
    int cell, step, last;
    double next, delta;  // distance along the ray to the next border, and between borders
  };
  const auto axis = [&](double origin, double direction, double low, int cell, int count) {
    Axis a{cell, direction > 0 ? 1 : -1, direction > 0 ? count - 1 : 0, kInfinity, 0};
    if (direction != 0) {
      const double border = low + (cell + (direction > 0 ? 1 : 0)) * grid.cellSize();
      a.next = (border - origin) / direction;
      a.delta = grid.cellSize() / std::abs(direction);
    }
    if (a.cell == a.last) a.next = kInfinity;
    return a;
  };
  Axis x = axis(ray.origin.x, ray.direction.x, grid.xMin(), grid.column(ray.origin.x), grid.columns());
  Axis y = axis(ray.origin.y, ray.direction.y, grid.yMin(), grid.row(ray.origin.y), grid.rows());
  while (true) {
    visit(x.cell, y.cell);
    Axis& nearer = x.next <= y.next ? x : y;
    if (nearer.next >= reach()) return;
    nearer.cell += nearer.step;
    nearer.next = nearer.cell == nearer.last ? kInfinity : nearer.next + nearer.delta;
  }
}

Bounds2D boundsOf(const Sector& sector, double range_m) {
  Bounds2D b{sector.apex.x, sector.apex.x, sector.apex.y, sector.apex.y};
  const auto include = [&](const TPoint2D& direction) {
    const double x = sector.apex.x + range_m * direction.x;
    const double y = sector.apex.y + range_m * direction.y;
    b = {std::min(b.x_min, x), std::max(b.x_max, x), std::min(b.y_min, y), std::max(b.y_max, y)};
  };
  include(sector.left);
  include(sector.right);
  for (const TPoint2D& most : {TPoint2D(1, 0), TPoint2D(0, 1), TPoint2D(-1, 0), TPoint2D(0, -1)}) {
    if (sector.holds(most)) include(most);
  }
  return b;
}

/// Distance [m] from a point to a cell; cells on the rim go on outwards.
double distanceToCell(const GridIndex& grid, int column, int row, const TPoint2D& p) {
  const auto gap = [&](double at, double low, int cell, int count) {
    const double begin = cell == 0 ? -kInfinity : low + cell * grid.cellSize();
    const double end = cell == count - 1 ? kInfinity : low + (cell + 1) * grid.cellSize();
    return std::max({0.0, begin - at, at - end});
  };
  return std::hypot(gap(p.x, grid.xMin(), column, grid.columns()), gap(p.y, grid.yMin(), row, grid.rows()));
}

void collectNear(const GridIndex& grid, const std::vector<Solid>& solids, std::uint32_t first_body,
                 const Bounds2D& area, std::vector<BodyId>& found) {
  const auto begin = static_cast<std::ptrdiff_t>(found.size());
  for (int row = grid.row(area.y_min); row <= grid.row(area.y_max); ++row) {
    for (int column = grid.column(area.x_min); column <= grid.column(area.x_max); ++column) {
      for (const auto i : grid.cell(column, row)) {
        const Bounds2D b = robosim::boundsOf(solids[i].outline);
        const bool meets =
            b.x_min <= area.x_max && area.x_min <= b.x_max && b.y_min <= area.y_max && area.y_min <= b.y_max;
        if (meets) found.push_back(BodyId(first_body + i));
      }
    }
  }
  std::sort(found.begin() + begin, found.end());
  found.erase(std::unique(found.begin() + begin, found.end()), found.end());
}

}  // namespace

Scene::Scene(std::vector<Solid> stationary, std::size_t moving_count, const Bounds2D& area)
    : stationary_(std::move(stationary)),
      moving_(moving_count),
      stationary_index_(area, cellFor(area, stationary_.size())),
      moving_index_(area, cellFor(area, moving_count)) {
  stationary_index_.build(stationary_);
  freeze();
}

const Solid& Scene::solid(BodyId body) const {
  const auto i = static_cast<std::size_t>(body);
  return i < stationary_.size() ? stationary_[i] : moving_[i - stationary_.size()];
}

void Scene::freeze() { moving_index_.build(moving_); }

Hit Scene::castRay(const Ray& ray, double range_m, BodyId except) const {
  Hit best;
  best.distance_m = range_m;
  const auto cast = [&](const GridIndex& grid, const std::vector<Solid>& solids, std::uint32_t first_body) {
    alongRay(
        grid, ray, [&] { return best.distance_m; },
        [&](int column, int row) {
          for (const auto i : grid.cell(column, row)) {
            const BodyId body{first_body + i};
            if (body == except) continue;
            const auto met = intersect(ray, solids[i]);
            if (met && better(*met, body, best)) best = {*met, body, {}};
          }
        });
  };
  cast(stationary_index_, stationary_, 0);
  cast(moving_index_, moving_, static_cast<std::uint32_t>(stationary_.size()));
  if (!best) return {};
  best.point = ray.at(best.distance_m);
  return best;
}

Hit Scene::senseSector(const Sector& sector, double range_m, BodyId except) const {
  Hit best;
  best.distance_m = range_m;
  const TPoint2D apex(sector.apex.x, sector.apex.y);
  const Bounds2D reach = boundsOf(sector, range_m);
  const auto sense = [&](const GridIndex& grid, const std::vector<Solid>& solids, std::uint32_t first_body) {
    const int right = grid.column(reach.x_max);
    const int top = grid.row(reach.y_max);
    for (int row = grid.row(reach.y_min); row <= top; ++row) {
      for (int column = grid.column(reach.x_min); column <= right; ++column) {
        const auto listed = grid.cell(column, row);
        if (listed.empty() || distanceToCell(grid, column, row, apex) > best.distance_m) continue;
        for (const auto i : listed) {
          const BodyId body{first_body + i};
          if (body == except) continue;
          const auto met = nearestInSector(sector, solids[i]);
          if (met && better(met->distance_m, body, best)) {
            best = {met->distance_m, body, {met->point.x, met->point.y, sector.apex.z}};
          }
        }
      }
    }
  };
  sense(stationary_index_, stationary_, 0);
  sense(moving_index_, moving_, static_cast<std::uint32_t>(stationary_.size()));
  return best ? best : Hit{};
}

void Scene::stationaryNear(const Bounds2D& area, std::vector<BodyId>& found) const {
  collectNear(stationary_index_, stationary_, 0, area, found);
}

void Scene::movingNear(const Bounds2D& area, std::vector<BodyId>& found) const {
  collectNear(moving_index_, moving_, static_cast<std::uint32_t>(stationary_.size()), area, found);
}

}  // namespace robosim
