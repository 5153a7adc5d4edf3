#include "geometry/scene.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/portable_math.h"
#include "geometry/casting/closest_hit.h"

namespace robosim {

namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Skin of a neighbour list [m]: several steps of a fast robot, yet small enough that the list stays short.
constexpr double kSkin_m = 0.7;
/// Maximum length of a neighbour list. Where more solids lie within reach, the nearest ones occlude most of the others.
constexpr std::size_t kMaxNeighbours = 64;
/// Slightly less than 1: the product never increases when rounded to float.
constexpr double kRoundDown = 1 - 1e-7;

/// Average number of stationary solids per cell, not counting those that extend over its borders: many cells fill most
/// of a pack, few need a second one.
constexpr double kStationaryPerCell = 3.5;

double cellFor(const Bounds2D& area, std::size_t stationary) {
  const double square_m2 = std::max(1e-6, (area.x_max - area.x_min) * (area.y_max - area.y_min));
  return std::max(0.25, std::sqrt(square_m2 * kStationaryPerCell / static_cast<double>(stationary + 4)));
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
  for (const TPoint2D& extreme : {TPoint2D(1, 0), TPoint2D(0, 1), TPoint2D(-1, 0), TPoint2D(0, -1)}) {
    if (sector.contains(extreme)) include(extreme);
  }
  return b;
}

/// Extends an area by whole cells so that it contains the solids that end not far beyond it; then most rays cannot hit
/// anything outside the grid. Solids that extend further are left to the border cells, because a solid may be
/// arbitrarily far away or long.
Bounds2D grownFor(const std::vector<Solid>& solids, const Bounds2D& area, double cell_m) {
  const double margin_m = 2 * GridIndex::borderMargin(cell_m);
  const double max_x = std::max(cell_m, (area.x_max - area.x_min) / 2);
  const double max_y = std::max(cell_m, (area.y_max - area.y_min) / 2);
  Bounds2D all = area;
  for (const auto& solid : solids) {
    const Bounds2D bounds = boundsOf(solid.outline);
    const Bounds2D with{std::min(all.x_min, bounds.x_min - margin_m), std::max(all.x_max, bounds.x_max + margin_m),
                        std::min(all.y_min, bounds.y_min - margin_m), std::max(all.y_max, bounds.y_max + margin_m)};
    if (area.x_min - with.x_min <= max_x && with.x_max - area.x_max <= max_x && area.y_min - with.y_min <= max_y &&
        with.y_max - area.y_max <= max_y) {
      all = with;
    }
  }
  const auto in_cells = [&](double length_m) { return std::ceil(length_m / cell_m) * cell_m; };
  const Bounds2D grown{area.x_min - in_cells(area.x_min - all.x_min), all.x_max,
                       area.y_min - in_cells(area.y_min - all.y_min), all.y_max};
  const double longer_m = std::max(grown.x_max - grown.x_min, grown.y_max - grown.y_min);
  return longer_m <= kMaxCells * cell_m ? grown : area;
}

GridIndex gridFor(const std::vector<Solid>& stationary, const Bounds2D& area) {
  const double cell_m = cellFor(area, stationary.size());
  return {grownFor(stationary, area, cell_m), cell_m};
}

/// Distance [m] from a point to a cell; border cells extend outwards without limit.
double distanceToCell(const GridIndex& grid, int column, int row, const TPoint2D& p) {
  const auto gap = [&](double at, double low, int cell, int count) {
    const double begin = cell == 0 ? -kInfinity : low + cell * grid.cellSize();
    const double end = cell == count - 1 ? kInfinity : low + (cell + 1) * grid.cellSize();
    return std::max({0.0, begin - at, at - end});
  };
  return portable::hypot(gap(p.x, grid.xMin(), column, grid.columns()), gap(p.y, grid.yMin(), row, grid.rows()));
}

bool intersect(const Bounds2D& a, const Bounds2D& b) {
  return a.x_min <= b.x_max && b.x_min <= a.x_max && a.y_min <= b.y_max && b.y_min <= a.y_max;
}

/// Marks the bodies that a query has already visited, because a body is listed in every cell it overlaps. One instance
/// per thread, shared by all scenes: each query uses a new mark value.
class VisitedBodies {
 public:
  static VisitedBodies& begin(std::size_t bodies) {
    static thread_local VisitedBodies visited;
    if (visited.marks_.size() < bodies) visited.marks_.resize(bodies, 0);
    if (++visited.mark_ == 0) {
      std::fill(visited.marks_.begin(), visited.marks_.end(), 0);
      visited.mark_ = 1;
    }
    return visited;
  }
  bool isFirst(std::uint32_t body) {
    const bool first = marks_[body] != mark_;
    marks_[body] = mark_;
    return first;
  }

 private:
  std::vector<std::uint32_t> marks_;
  std::uint32_t mark_ = 0;
};

/// Visits the cells around a point, ring by ring outwards, until all remaining cells are farther than reach().
template <typename Reach, typename Visit>
void visitOutwards(const GridIndex& grid, const TPoint2D& center, const Reach& reach, const Visit& visit) {
  const int column = grid.column(center.x);
  const int row = grid.row(center.y);
  const int last_column = grid.columns() - 1;
  const int last_row = grid.rows() - 1;
  visit(column, row);
  for (int ring = 1;; ++ring) {
    const int left = column - ring;
    const int right = column + ring;
    const int bottom = row - ring;
    const int top = row + ring;
    // The area covered by this ring and those beyond it begins at the border of the square inside it; outside the grid
    // nothing is left.
    const double to_left = left < 0 ? kInfinity : center.x - (grid.xMin() + (left + 1) * grid.cellSize());
    const double to_right = right > last_column ? kInfinity : grid.xMin() + right * grid.cellSize() - center.x;
    const double to_bottom = bottom < 0 ? kInfinity : center.y - (grid.yMin() + (bottom + 1) * grid.cellSize());
    const double to_top = top > last_row ? kInfinity : grid.yMin() + top * grid.cellSize() - center.y;
    // Finite, so that a side outside the grid is beyond any reach.
    const double far = std::min(reach(), std::numeric_limits<double>::max());
    if (std::min({to_left, to_right, to_bottom, to_top}) > far) return;
    // Skips sides beyond the reach, and the cells of the other two sides in their rows or columns.
    const int from_x = std::max(0, to_left > far ? left + 1 : left);
    const int to_x = std::min(last_column, to_right > far ? right - 1 : right);
    const int from_y = std::max(bottom + 1, 0);
    const int to_y = std::min(top - 1, last_row);
    if (to_bottom <= far) {
      for (int x = from_x; x <= to_x; ++x) visit(x, bottom);
    }
    if (to_top <= far) {
      for (int x = from_x; x <= to_x; ++x) visit(x, top);
    }
    if (to_left <= far) {
      for (int y = from_y; y <= to_y; ++y) visit(left, y);
    }
    if (to_right <= far) {
      for (int y = from_y; y <= to_y; ++y) visit(right, y);
    }
  }
}

}  // namespace

Scene::Scene(const std::vector<Solid>& stationary, std::size_t moving_count, const Bounds2D& area)
    : stationary_index_(gridFor(stationary, area)), moving_index_(moving_count, stationary_index_.middle()) {
  stationary_index_.build(stationary);
  freeze();
}

Solid Scene::solid(BodyId body) const {
  const auto i = static_cast<std::size_t>(body);
  return (i < stationaryCount() ? stationary_index_.items()[stationary_index_.indexOf(i)]
                                : moving_index_.items()[i - stationaryCount()])
      .solid();
}

void Scene::cast(BeamBatch& batch, BodyId except, const NeighbourList& near) const {
  if (batch.size() == 0) return;
  Candidates candidates;
  const auto intersect = [&] {
    if (candidates.count > 0) batch.intersect(candidates);
    candidates.count = 0;
  };
  const auto add_if = [&](bool is_candidate, const GridItem& item, std::uint32_t body) {
    candidates.addIf(is_candidate & batch.mayHit(item), item, body);
    if (candidates.isFull()) intersect();
  };
  const auto add = [&](std::uint32_t i) {
    const GridItem& item = stationary_index_.items()[i];
    add_if(BodyId{item.number} != except, item, item.number);
  };
  const auto reach = [&] { return batch.reach(); };
  if (!near.visitNear(batch.center(), reach, add)) {
    VisitedBodies& visited = VisitedBodies::begin(stationaryCount());
    const CellHalfPlaneCull ahead(batch.halfPlane(), {stationary_index_.xMin(), stationary_index_.yMin()},
                                  stationary_index_.cellSize());
    visitOutwards(stationary_index_, batch.center(), reach, [&](int column, int row) {
      if (!ahead.mayContain(column, row) && !stationary_index_.isBorderCell(column, row)) return;
      stationary_index_.visitCell(column, row, [&](std::uint32_t i) {
        if (visited.isFirst(i)) add(i);
      });
    });
  }
  const RangeCull surroundings(batch.center(), batch.reach(), moving_index_.middle());
  const auto first = static_cast<std::uint32_t>(stationaryCount());
  moving_index_.visitNear(surroundings.bounds(), [&](const CenterIndex::Entry& entry) {
    add_if(surroundings.mayContain(entry.solid) & (BodyId{first + entry.index} != except),
           moving_index_.items()[entry.index], first + entry.index);
  });
  intersect();
}

void Scene::update(NeighbourList& near, const TPoint2D& at, double reach_m) const {
  if (near.driftTo(at) <= kSkin_m) return;
  // Packs distance and index into one integer that sorts by distance: the bits of non-negative floats are ordered like
  // the floats.
  static thread_local std::vector<std::uint64_t> found;
  double covered_m = reach_m + kSkin_m;
  std::size_t count = 0;
  forCells({at.x - covered_m, at.x + covered_m, at.y - covered_m, at.y + covered_m}, [&](std::uint32_t i) {
    const double nearest_m = stationary_index_.items()[i].distanceTo(at);
    const auto rounded_m = static_cast<float>(nearest_m * kRoundDown);
    if (count == found.size()) found.resize(2 * count + 64);
    found[count] = std::uint64_t{std::bit_cast<std::uint32_t>(rounded_m)} << 32 | i;
    count += nearest_m <= covered_m ? 1 : 0;  // branch-free, because the condition is unpredictable
  });
  const auto begin = found.begin();
  std::sort(begin, begin + static_cast<std::ptrdiff_t>(count));
  const auto end = std::unique(begin, begin + static_cast<std::ptrdiff_t>(count));
  const auto distance = [](std::uint64_t key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); };
  static thread_local std::vector<NeighbourList::Neighbour> nearest_first;
  nearest_first.clear();
  for (auto key = begin; key != end; ++key) {
    if (nearest_first.size() == kMaxNeighbours) {
      covered_m = distance(*key);
      break;
    }
    nearest_first.push_back({distance(*key), static_cast<std::uint32_t>(*key)});
  }
  near.set(at, covered_m, nearest_first);
}

Hit Scene::senseSector(const Sector& sector, double range_m, BodyId except) const {
  ClosestHit best{range_m};
  TPoint2D point;
  const TPoint2D apex(sector.apex.x, sector.apex.y);
  const Bounds2D reach = boundsOf(sector, range_m);
  const auto sense = [&](BodyId body) {
    if (body == except) return;
    const auto hit = nearestInSector(sector, solid(body));
    if (!hit || !best.isWorseThan(hit->distance_m, body)) return;
    best = {hit->distance_m, body};
    point = hit->point;
  };
  const GridIndex& grid = stationary_index_;
  const int right = grid.column(reach.x_max);
  const int top = grid.row(reach.y_max);
  for (int row = grid.row(reach.y_min); row <= top; ++row) {
    for (int column = grid.column(reach.x_min); column <= right; ++column) {
      if (distanceToCell(grid, column, row, apex) > best.distance_m) continue;
      grid.visitCell(column, row, [&](std::uint32_t i) { sense(stationaryBody(i)); });
    }
  }
  moving_index_.visitNear(reach, [&](const CenterIndex::Entry& entry) { sense(movingBody(entry.index)); });
  if (best.body == kNoBody) return {};
  return {best.distance_m, best.body, {point.x, point.y, sector.apex.z}};
}

template <typename Visit>
void Scene::forCells(const Bounds2D& area, const Visit& visit) const {
  const GridIndex& grid = stationary_index_;
  const int right = grid.column(area.x_max);
  const int top = grid.row(area.y_max);
  for (int row = grid.row(area.y_min); row <= top; ++row) {
    for (int column = grid.column(area.x_min); column <= right; ++column) {
      grid.visitCell(column, row, visit);
    }
  }
}

void Scene::stationaryNear(const Bounds2D& area, std::vector<BodyId>& found) const {
  const auto begin = static_cast<std::ptrdiff_t>(found.size());
  forCells(area, [&](std::uint32_t i) {
    const GridItem& item = stationary_index_.items()[i];
    if (intersect(item.bounds(), area)) found.push_back(BodyId{item.number});
  });
  std::sort(found.begin() + begin, found.end());
  found.erase(std::unique(found.begin() + begin, found.end()), found.end());
}

void Scene::movingNear(const Bounds2D& area, std::vector<BodyId>& found) const {
  const auto begin = static_cast<std::ptrdiff_t>(found.size());
  moving_index_.visitNear(area, [&](const CenterIndex::Entry& entry) {
    if (intersect(moving_index_.items()[entry.index].bounds(), area)) found.push_back(movingBody(entry.index));
  });
  std::sort(found.begin() + begin, found.end());
}

}  // namespace robosim
