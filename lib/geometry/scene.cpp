#include "geometry/scene.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geometry/nearest_so_far.h"
#include "geometry/vector_loops.h"

namespace robosim {

namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// How far [m] an owner of a neighbour list goes before it is made anew: some steps of a quick robot; not so far that
/// the list grows much.
constexpr double kSkin_m = 0.7;
/// Of a neighbour list. Where more lie within reach, the nearest ones hide most of the rest.
constexpr std::size_t kMostNeighbours = 64;
/// A little less than 1: no number times this grows when it becomes a float.
constexpr double kRoundDown = 1 - 1e-7;

/// Stationary solids in a cell on average, those aside that reach over its borders: many fill most of a pack, few need
/// a second.
constexpr double kStationaryPerCell = 3.5;
constexpr double kMovingPerCell = 1;

double cellFor(const Bounds2D& area, std::size_t solids, double per_cell) {
  const double square_m2 = std::max(1e-6, (area.x_max - area.x_min) * (area.y_max - area.y_min));
  return std::max(0.25, std::sqrt(square_m2 * per_cell / static_cast<double>(solids + 4)));
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

/// An area, and cells around it as far as solids reach that lie not far beyond: most often there is nothing then that a
/// ray might meet outside. Those that go further are left to the cells of the rim, for a solid may be as far or as long
/// as it likes.
Bounds2D grownFor(const std::vector<Solid>& solids, const Bounds2D& area, double cell_m) {
  const double room_m = 2 * GridIndex::roomAtRim(cell_m);
  const double most_x = std::max(cell_m, (area.x_max - area.x_min) / 2);
  const double most_y = std::max(cell_m, (area.y_max - area.y_min) / 2);
  Bounds2D all = area;
  for (const auto& solid : solids) {
    const Bounds2D bounds = boundsOf(solid.outline);
    const Bounds2D with{std::min(all.x_min, bounds.x_min - room_m), std::max(all.x_max, bounds.x_max + room_m),
                        std::min(all.y_min, bounds.y_min - room_m), std::max(all.y_max, bounds.y_max + room_m)};
    if (area.x_min - with.x_min <= most_x && with.x_max - area.x_max <= most_x && area.y_min - with.y_min <= most_y &&
        with.y_max - area.y_max <= most_y) {
      all = with;
    }
  }
  const auto in_cells = [&](double length_m) { return std::ceil(length_m / cell_m) * cell_m; };
  const Bounds2D grown{area.x_min - in_cells(area.x_min - all.x_min), all.x_max,
                       area.y_min - in_cells(area.y_min - all.y_min), all.y_max};
  const double longer_m = std::max(grown.x_max - grown.x_min, grown.y_max - grown.y_min);
  return longer_m <= kMostCells * cell_m ? grown : area;
}

GridIndex gridFor(const std::vector<Solid>& stationary, const Bounds2D& area) {
  const double cell_m = cellFor(area, stationary.size(), kStationaryPerCell);
  return {grownFor(stationary, area, cell_m), cell_m};
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

bool meet(const Bounds2D& a, const Bounds2D& b) {
  return a.x_min <= b.x_max && b.x_min <= a.x_max && a.y_min <= b.y_max && b.y_min <= a.y_max;
}

/// Marks which bodies a question has looked at already: a body is listed in every cell it reaches into. One for each
/// thread, for all scenes: a question's mark is a number never used before.
class Seen {
 public:
  static Seen& begin(std::size_t bodies) {
    static thread_local Seen seen;
    if (seen.marks_.size() < bodies) seen.marks_.resize(bodies, 0);
    if (++seen.mark_ == 0) {
      std::fill(seen.marks_.begin(), seen.marks_.end(), 0);
      seen.mark_ = 1;
    }
    return seen;
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

/// Visits the cells around a point, ring by ring outwards, until all that are left lie further than reach() from it.
template <typename Reach, typename Visit>
void outwards(const GridIndex& grid, const TPoint2D& center, const Reach& reach, const Visit& visit) {
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
    // What this ring and those beyond it cover begins at the border of the square inside it; at the rim nothing is
    // left.
    const double to_left = left < 0 ? kInfinity : center.x - (grid.xMin() + (left + 1) * grid.cellSize());
    const double to_right = right > last_column ? kInfinity : grid.xMin() + right * grid.cellSize() - center.x;
    const double to_bottom = bottom < 0 ? kInfinity : center.y - (grid.yMin() + (bottom + 1) * grid.cellSize());
    const double to_top = top > last_row ? kInfinity : grid.yMin() + top * grid.cellSize() - center.y;
    const double far = std::min(reach(), std::numeric_limits<double>::max());  // so that the rim lies beyond any reach
    if (std::min({to_left, to_right, to_bottom, to_top}) > far) return;
    // A side that lies too far is left out; so are a far side's ends of the other two.
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

/// Hands a batch what it may meet, a pack at a time.
template <typename Batch, typename Index>
class Gathering {
 public:
  /// @param except an index, which is left out; one beyond all leaves out nothing
  Gathering(Batch& batch, const Index& index, std::size_t first_body, std::uint32_t except)
      : batch_(batch),
        front_(batch.front(), index.middle()),
        except_(except),
        candidates_{emptyPack(), index.items().data(), index.middle(), static_cast<std::uint32_t>(first_body)} {}

  /// Whether a solid matters is anybody's guess, so nothing here branches on it.
  void addIf(bool wanted, const RoughSolid& solid, std::uint32_t index) {
    pack_.addIf(wanted & front_.mayHold(solid) & (index != except_), solid, index);
    if (pack_.isFull()) finish();
  }
  void add(const RoughSolid& solid, std::uint32_t index) { addIf(true, solid, index); }
  void finish() {
    if (pack_.count == 0) return;
    batch_.meet(candidates_);
    pack_.count = 0;
  }

 private:
  static Candidates::Pack& emptyPack() {
    static thread_local Candidates::Pack pack;
    pack.count = 0;
    return pack;
  }

  Batch& batch_;
  RoughFront front_;
  std::uint32_t except_;
  Candidates::Pack& pack_ = emptyPack();
  Candidates candidates_;
};

}  // namespace

Scene::Scene(const std::vector<Solid>& stationary, std::size_t moving_count, const Bounds2D& area)
    : stationary_index_(gridFor(stationary, area)),
      moving_index_(area, cellFor(area, moving_count, kMovingPerCell), moving_count) {
  stationary_index_.build(stationary);
  freeze();
}

Solid Scene::solid(BodyId body) const {
  const auto i = static_cast<std::size_t>(body);
  return (i < stationaryCount() ? stationary_index_.items()[stationary_index_.indexOf(i)]
                                : moving_index_.items()[i - stationaryCount()])
      .solid();
}

template <typename Batch>
void Scene::meetAll(Batch& batch, BodyId except, const NeighbourList& near) const {
  if (batch.size() == 0) return;
  const auto number = static_cast<std::size_t>(except);
  constexpr auto kNone = static_cast<std::uint32_t>(kNoBody);
  Gathering stationary(batch, stationary_index_, 0,
                       number < stationaryCount() ? stationary_index_.indexOf(number) : kNone);
  const auto reach = [&] { return batch.reach(); };
  if (!near.visitNear(batch.center(), reach,
                      [&](std::uint32_t i) { stationary.add(stationary_index_.rough()[i], i); })) {
    Seen& seen = Seen::begin(stationaryCount());
    const CellsAhead ahead(batch.front(), {stationary_index_.xMin(), stationary_index_.yMin()},
                           stationary_index_.cellSize());
    outwards(stationary_index_, batch.center(), reach, [&](int column, int row) {
      if (!ahead.mayHold(column, row) && !stationary_index_.isOnRim(column, row)) return;
      stationary_index_.visitCell(column, row, [&](std::uint32_t i) {
        if (seen.isFirst(i)) stationary.add(stationary_index_.rough()[i], i);
      });
    });
  }
  stationary.finish();

  Gathering moving(batch, moving_index_, stationaryCount(),
                   number < stationaryCount() ? kNone : static_cast<std::uint32_t>(movingIndex(except)));
  const Near surroundings(batch.center(), batch.reach(), moving_index_.middle());
  moving_index_.visitNear(surroundings.bounds(), [&](const CenterIndex::Entry& entry) {
    moving.addIf(surroundings.mayHold(entry.solid), entry.solid, entry.index);
  });
  moving.finish();
  batch.finish();
}

void Scene::castRays(RayBatch& batch, BodyId except, const NeighbourList& near) const { meetAll(batch, except, near); }
void Scene::senseSectors(SectorBatch& batch, BodyId except, const NeighbourList& near) const {
  meetAll(batch, except, near);
}

void Scene::update(NeighbourList& near, const TPoint2D& at, double reach_m) const {
  if (near.driftTo(at) <= kSkin_m) return;
  // Distance and index in one number, which sorts by the first as it is: the bits of floats that are not negative do.
  static thread_local std::vector<std::uint64_t> found;
  double covered_m = reach_m + kSkin_m;
  std::size_t count = 0;
  forCells({at.x - covered_m, at.x + covered_m, at.y - covered_m, at.y + covered_m}, [&](std::uint32_t i) {
    const double nearest_m = stationary_index_.items()[i].distanceTo(at);
    const auto rounded_m = static_cast<float>(nearest_m * kRoundDown);
    if (count == found.size()) found.resize(2 * count + 64);
    found[count] = std::uint64_t{std::bit_cast<std::uint32_t>(rounded_m)} << 32 | i;
    count += nearest_m <= covered_m ? 1 : 0;  // anybody's guess, so without a branch
  });
  const auto begin = found.begin();
  std::sort(begin, begin + static_cast<std::ptrdiff_t>(count));
  const auto end = std::unique(begin, begin + static_cast<std::ptrdiff_t>(count));
  const auto distance = [](std::uint64_t key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); };
  static thread_local std::vector<NeighbourList::Neighbour> nearest_first;
  nearest_first.clear();
  for (auto key = begin; key != end; ++key) {
    if (nearest_first.size() == kMostNeighbours) {
      covered_m = distance(*key);
      break;
    }
    nearest_first.push_back({distance(*key), static_cast<std::uint32_t>(*key)});
  }
  near.set(at, covered_m, nearest_first);
}

Hit Scene::senseSector(const Sector& sector, double range_m, BodyId except) const {
  NearestSoFar best{range_m};
  TPoint2D point;
  const TPoint2D apex(sector.apex.x, sector.apex.y);
  const Bounds2D reach = boundsOf(sector, range_m);
  const auto sense = [&](BodyId body) {
    if (body == except) return;
    const auto met = nearestInSector(sector, solid(body));
    if (!met || !best.isWorseThan(met->distance_m, body)) return;
    best = {met->distance_m, body};
    point = met->point;
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
    if (meet(item.bounds(), area)) found.push_back(BodyId{item.number});
  });
  std::sort(found.begin() + begin, found.end());
  found.erase(std::unique(found.begin() + begin, found.end()), found.end());
}

void Scene::movingNear(const Bounds2D& area, std::vector<BodyId>& found) const {
  const auto begin = static_cast<std::ptrdiff_t>(found.size());
  moving_index_.visitNear(area, [&](const CenterIndex::Entry& entry) {
    if (meet(moving_index_.items()[entry.index].bounds(), area)) found.push_back(movingBody(entry.index));
  });
  std::sort(found.begin() + begin, found.end());
}

}  // namespace robosim
