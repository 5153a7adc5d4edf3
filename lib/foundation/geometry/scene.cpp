#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/casting/bearing_cull.h"
#include "geometry/scene_index.h"

namespace robosim {

namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Average number of stationary solids per cell, not counting those that extend over its borders: many cells fill most
/// of a pack, few need a second one.
constexpr double kStationaryPerCell = 3.5;

double cellFor(const Bounds2D& area, std::size_t stationary) {
  const double square_m2 = std::max(1e-6, (area.x_max - area.x_min) * (area.y_max - area.y_min));
  return std::max(0.25, std::sqrt(square_m2 * kStationaryPerCell / static_cast<double>(stationary + 4)));
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
    const double to_left = left < 0 ? kInfinity : center.x - (grid.low().x + (left + 1) * grid.cellSize());
    const double to_right = right > last_column ? kInfinity : grid.low().x + right * grid.cellSize() - center.x;
    const double to_bottom = bottom < 0 ? kInfinity : center.y - (grid.low().y + (bottom + 1) * grid.cellSize());
    const double to_top = top > last_row ? kInfinity : grid.low().y + top * grid.cellSize() - center.y;
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

std::shared_ptr<const GridIndex> indexStationary(const std::vector<Solid>& solids, const Bounds2D& area) {
  const double cell_m = cellFor(area, solids.size());
  const auto grid = std::make_shared<GridIndex>(grownFor(solids, area, cell_m), cell_m);
  grid->build(solids);
  return grid;
}

Scene::Scene(const std::vector<Solid>& stationary, std::size_t moving_count, const Bounds2D& area)
    : Scene(indexStationary(stationary, area), moving_count) {}

Scene::Scene(std::shared_ptr<const GridIndex> stationary, std::size_t moving_count)
    : stationary_count_(stationary->items().size()), moving_count_(moving_count) {
  const GridIndex& grid = *stationary;
  index_ = std::make_unique<SceneIndex>(SceneIndex{
      std::move(stationary), grid, CenterIndex(moving_count, grid.middle()), std::vector<NeighbourList>(moving_count)});
  freeze();
}

Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

const std::shared_ptr<const GridIndex>& Scene::stationary() const { return index_->shared_stationary; }
Solid Scene::solid(BodyId body) const { return index_->item(body).solid(); }
void Scene::place(std::size_t i, const Solid& solid) { index_->moving.set(i, solid); }
void Scene::remove(std::size_t i) { index_->moving.remove(i); }
void Scene::freeze() { index_->moving.build(); }
void Scene::freeze(const ParallelExecutor& workers) { index_->moving.build(workers); }
void Scene::freeze(const ParallelExecutor& workers, std::span<const std::uint32_t> moving) {
  index_->moving.build(workers, moving);
}

void Scene::updateNeighbours(std::size_t i, double reach_m) {
  const GridItem& owner = index_->moving.items()[i];
  index_->neighbours[i].update(index_->stationary, {owner.x, owner.y}, reach_m);
}

std::size_t Scene::neighbourCount(std::size_t i) const { return index_->neighbours[i].size(); }

namespace {

/// Adds the neighbours of the owner of beams that the beams may hit.
/// @param intersect makes room for candidates, and may reduce reach()
/// @return whether there are no further solids that they may hit
template <typename Reach, typename MayContain, typename Intersect>
bool addNeighbours(const NeighbourList& list, const GridIndex& grid, const TPoint2D& from, const Reach& reach,
                   const MayContain& may_contain, Candidates& candidates, const Intersect& intersect) {
  const GridItem* const items = grid.items().data();
  const double drift_m = list.driftTo(from);
  for (auto left = list.nearestFirst(); !left.empty();) {
    const float limit_m = NeighbourList::limitOf(reach() + drift_m);
    const auto together = left.first(std::min(left.size(), Candidates::kCapacity - candidates.count));
    for (const auto& neighbour : together) {
      if (neighbour.nearest_m > limit_m) return true;
      const GridItem& item = items[neighbour.solid];
      if (may_contain(item)) candidates.add(item, grid.numberOf(neighbour.solid));
    }
    left = left.subspan(together.size());
    if (candidates.isFull()) intersect();
  }
  return list.covers(reach() + drift_m);
}

}  // namespace

void Scene::cast(BeamBatch& batch, BodyId owner) const {
  if (batch.size() == 0) return;
  const GridIndex& grid = index_->stationary;
  const CenterIndex& moving = index_->moving;
  const HalfPlaneCull half_plane{batch.center_, batch.facing_, batch.spread_m_};
  Candidates candidates;
  const auto intersect = [&] {
    if (candidates.count > 0) batch.intersect(candidates);
    candidates.count = 0;
  };
  const auto add = [&](const GridItem& item, std::uint32_t body) {
    candidates.addIf(BodyId{body} != owner, item, body);
    if (candidates.isFull()) intersect();
  };
  const auto reach = [&] { return batch.reach(); };
  const bool is_all_round = half_plane.isEverything();
  const auto add_neighbours = [&](const NeighbourList& list) {
    if (is_all_round) {
      return addNeighbours(
          list, grid, batch.center_, reach, [](const GridItem&) { return true; }, candidates, intersect);
    }
    return addNeighbours(
        list, grid, batch.center_, reach, [&](const GridItem& item) { return half_plane.mayContain(item); }, candidates,
        intersect);
  };
  const NeighbourList* const neighbours = index_->neighboursOf(owner);
  if (!neighbours || !add_neighbours(*neighbours)) {
    VisitedBodies& visited = VisitedBodies::begin(grid.items().size());
    const CellHalfPlaneCull ahead(half_plane, grid.low(), grid.cellSize());
    visitOutwards(grid, batch.center_, reach, [&](int column, int row) {
      if (!ahead.mayContain(column, row) && !grid.isBorderCell(column, row)) return;
      grid.visitCell(column, row, [&](std::uint32_t i) {
        const GridItem& item = grid.items()[i];
        if (visited.isFirst(i) && (is_all_round || half_plane.mayContain(item))) {
          add(item, grid.numberOf(i));
        }
      });
    });
  }
  const RangeCull surroundings(half_plane, batch.reach(), moving.middle());
  const GridItem* const items = moving.items().data();
  const std::uint32_t first_moving = index_->firstMoving();
  moving.visitNear(surroundings, [&](std::uint32_t i) { add(items[i], first_moving + i); });
  intersect();
}

void Scene::clip(Path& path, double radius_m, const HeightSpan& heights, BodyId owner) const {
  const TPoint2D start(path.world_from_start.x, path.world_from_start.y);
  const double reach_m = radius_m + std::abs(path.length_m) + 2 * kContactGap_m;  // more than a contact's, for rounding
  const GridIndex& grid = index_->stationary;
  const auto clip_at = [&](std::uint32_t i) {
    const GridItem& item = grid.items()[i];
    if (item.distanceTo(start) > reach_m || !item.heights.overlaps(heights)) return;
    path.end_fraction = std::min(path.end_fraction, firstContact(path, radius_m, item.solid().outline));
  };
  const NeighbourList* const neighbours = index_->neighboursOf(owner);
  if (neighbours && neighbours->visitNear(start, reach_m, clip_at)) return;
  grid.visitArea({start.x - reach_m, start.x + reach_m, start.y - reach_m, start.y + reach_m}, clip_at);
}

void Scene::findMoving(const TPoint2D& at, double reach_m, std::size_t count, std::vector<std::uint32_t>& found) const {
  found.clear();
  const RangeCull near({at, {}, 0}, reach_m, index_->moving.middle());
  index_->moving.visitNear(near, [&](std::uint32_t i) {
    if (i < count) found.push_back(i);
  });
}

void Scene::findBodies(const Bounds2D& area, std::vector<BodyId>& found) const {
  const auto begin = static_cast<std::ptrdiff_t>(found.size());
  const auto add_if_near = [&](const GridItem& item, BodyId body) {
    if (intersect(item.bounds(), area)) found.push_back(body);
  };
  index_->stationary.visitArea(area, [&](std::uint32_t i) {
    add_if_near(index_->stationary.items()[i], BodyId{index_->stationary.numberOf(i)});
  });
  index_->moving.visitNear(area, [&](const CenterIndex::Entry& entry) {
    add_if_near(index_->moving.items()[entry.index], index_->movingBody(entry.index));
  });
  std::sort(found.begin() + begin, found.end());
  found.erase(std::unique(found.begin() + begin, found.end()), found.end());
}

void Scene::findSolids(const Bounds2D& area, std::vector<FoundSolid>& found) const {
  const auto add_if_near = [&](const GridItem& item, BodyId body) {
    if (!intersect(item.bounds(), area)) return;
    found.push_back(
        {{item.x, item.y}, {item.axis_x, item.axis_y}, item.half_length_m, item.half_width_m, item.heights, body});
  };
  const GridIndex& grid = index_->stationary;
  VisitedBodies& visited = VisitedBodies::begin(grid.items().size());
  grid.visitArea(area, [&](std::uint32_t i) {
    if (visited.isFirst(i)) add_if_near(grid.items()[i], BodyId{grid.numberOf(i)});
  });
  index_->moving.visitNear(area, [&](const CenterIndex::Entry& entry) {
    add_if_near(index_->moving.items()[entry.index], index_->movingBody(entry.index));
  });
}

}  // namespace robosim
