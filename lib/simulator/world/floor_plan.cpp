#include "world/floor_plan.h"

#include <algorithm>
#include <cmath>

#include "base/portable_pose.h"
#include "geometry/shapes/planar_transform.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Axis-aligned bounding rectangle of boxes.
class Hull {
 public:
  void include(const PlanarTransform& frame, double x_from, double x_to, double y_from, double y_to) {
    for (const double x : {x_from, x_to}) {
      for (const double y : {y_from, y_to}) include(frame.pointToWorld(TPoint2D(x, y)));
    }
  }
  void include(const TPoint2D& p) {
    if (is_empty_) hull_ = {p.x, p.x, p.y, p.y};
    is_empty_ = false;
    hull_ = {std::min(hull_.x_min, p.x), std::max(hull_.x_max, p.x), std::min(hull_.y_min, p.y),
             std::max(hull_.y_max, p.y)};
  }
  bool isEmpty() const { return is_empty_; }
  const Bounds2D& bounds() const { return hull_; }

 private:
  Bounds2D hull_;
  bool is_empty_ = true;
};

}  // namespace

std::uint64_t FloorPlan::occupiedCells() const {
  std::uint64_t count = 0;
  for (const auto& rectangle : occupied) count += std::uint64_t{rectangle.columns} * rectangle.rows;
  return count;
}

void CellMerger::add(std::uint32_t row, std::uint32_t first_column, std::uint32_t end_column) {
  if (row != row_) {
    closeRow();
    if (row != row_ + 1) closeRow();
    row_ = row;
  }
  here_.push_back({first_column, row, end_column - first_column, 1});
}

void CellMerger::closeRow() {
  auto below = below_.begin();
  for (auto& run : here_) {
    while (below != below_.end() && below->column < run.column) done_.push_back(*below++);
    if (below == below_.end() || below->column != run.column || below->columns != run.columns) continue;
    run.row = below->row;
    run.rows = below->rows + 1;
    ++below;
  }
  done_.insert(done_.end(), below, below_.end());
  below_.swap(here_);
  here_.clear();
}

std::vector<CellRectangle> CellMerger::finish() {
  closeRow();
  closeRow();
  return std::move(done_);
}

FloorPlan toFloorPlan(const OccupancyGrid& grid, bool unknown_is_occupied) {
  FloorPlan plan;
  plan.columns = grid.columns;
  plan.rows = grid.rows;
  plan.cell_m = grid.cell_m;
  plan.map_from_grid = grid.map_from_grid;
  const auto merged = [&](const auto& stands) {
    CellMerger merger;
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
      const auto begin = grid.cells.begin() + static_cast<std::ptrdiff_t>(std::size_t{row} * grid.columns);
      const auto end = begin + grid.columns;
      for (auto at = std::find_if(begin, end, stands); at != end; at = std::find_if(at, end, stands)) {
        const auto first = at;
        at = std::find_if_not(at, end, stands);
        merger.add(row, static_cast<std::uint32_t>(first - begin), static_cast<std::uint32_t>(at - begin));
      }
    }
    return merger.finish();
  };
  plan.occupied = merged([&](Occupancy cell) {
    return cell == Occupancy::occupied || (unknown_is_occupied && cell == Occupancy::unknown);
  });
  if (!unknown_is_occupied) plan.unknown = merged([](Occupancy cell) { return cell == Occupancy::unknown; });
  return plan;
}

Bounds2D boundsOf(const FloorPlan& plan, const TPose2D& world_from_map) {
  Hull hull;
  if (plan.columns > 0) {
    hull.include(PlanarTransform(portable::compose(world_from_map, plan.map_from_grid), 0), 0,
                 plan.columns * plan.cell_m, 0, plan.rows * plan.cell_m);
  }
  for (const auto& box : plan.boxes) {
    hull.include(PlanarTransform(portable::compose(world_from_map, box.map_from_box), 0), -box.length_m / 2,
                 box.length_m / 2, -box.width_m / 2, box.width_m / 2);
  }
  if (hull.isEmpty()) hull.include({world_from_map.x, world_from_map.y});
  return hull.bounds();
}

double computeSeam(const FloorPlan& plan, const TPose2D& world_from_map) {
  const Bounds2D b = boundsOf(plan, world_from_map);
  const double far_m = std::max({std::abs(b.x_min), std::abs(b.x_max), std::abs(b.y_min), std::abs(b.y_max)});
  return 1e-9 + 4 * std::numeric_limits<double>::epsilon() * far_m;
}

void addSolids(const FloorPlan& plan, const TPose2D& world_from_map, const HeightSpan& heights,
               std::vector<Solid>& solids) {
  const double seam_m = computeSeam(plan, world_from_map);
  solids.reserve(solids.size() + plan.occupied.size() + plan.boxes.size());
  const PlanarTransform grid(portable::compose(world_from_map, plan.map_from_grid), 0);
  const TPoint2D along(grid.cos(), grid.sin());
  for (const auto& cells : plan.occupied) {
    const TPoint2D center((cells.column + cells.columns / 2.0) * plan.cell_m,
                          (cells.row + cells.rows / 2.0) * plan.cell_m);
    solids.push_back({OrientedBox{grid.pointToWorld(center), along, cells.columns * plan.cell_m / 2 + seam_m,
                                  cells.rows * plan.cell_m / 2 + seam_m},
                      heights});
  }
  for (const auto& box : plan.boxes) {
    solids.push_back({OrientedBox::from(portable::compose(world_from_map, box.map_from_box), box.length_m + 2 * seam_m,
                                        box.width_m + 2 * seam_m),
                      heights});
  }
}

}  // namespace robosim
