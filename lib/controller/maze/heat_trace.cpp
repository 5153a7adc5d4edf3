#include "maze/heat_trace.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"

namespace robosim {
namespace {

constexpr double kReachMax_cells =
    30;  // independent of the sensor's range: farther cells add little information and cost time

/// Radius [m] around the robot within which gold would have been detected. It is reduced by the radii of robot and
/// gold, since a robot cannot approach gold more closely.
double searchRadius(double range_m, double robot_radius_m) {
  return std::max(0.5 * range_m, range_m - 2.5 * robot_radius_m);
}

}  // namespace

HeatTrace::HeatTrace(MazeMap& map, double range_m, double robot_radius_m)
    : map_(&map),
      range_m_(range_m),
      reach_cells_(static_cast<int>(std::min<double>(kReachMax_cells, range_m / map.cellSize()))) {
  const double cell_m = map.cellSize();
  const double search_m = searchRadius(range_m, robot_radius_m);
  for (int y = -reach_cells_; y <= reach_cells_; ++y) {
    for (int x = -reach_cells_; x <= reach_cells_; ++x) {
      const double distance_m = portable::hypot(x, y) * cell_m;
      if (distance_m >= range_m) continue;
      votes_.push_back({{x, y}, static_cast<float>(1 - distance_m / range_m), distance_m <= search_m});
    }
  }
}

bool HeatTrace::measure(const mrpt::math::TPoint2D& robot, double heat) {
  if (last_ && (robot - last_->place).norm() < map_->cellSize()) return false;
  last_ = {robot, heat};
  if (!hottest_ ? heat > 0 : heat > hottest_->heat) hottest_ = last_;
  const Cell at = map_->cellAt(robot);
  const auto h = static_cast<float>(heat);
  for (const Vote& vote : votes_) {
    const Cell cell{at.x + vote.offset.x, at.y + vote.offset.y};
    if (!map_->contains(cell)) continue;
    MapCell& here = (*map_)[cell];
    here.heat_weight += vote.weight * vote.weight;
    here.heat_match += h * vote.weight;
    here.searched |= vote.searched;
    here.stood |= std::abs(vote.offset.x) <= 1 && std::abs(vote.offset.y) <= 1;
  }
  return true;
}

void HeatTrace::reset() {
  last_.reset();
  hottest_.reset();
}

std::optional<HeatTrace::Source> HeatTrace::source() const {
  if (!hottest_) return std::nullopt;
  const Cell at = map_->cellAt(hottest_->place);
  std::optional<Source> best;
  float best_explained = 0;
  for (const Vote& vote : votes_) {
    const Cell cell{at.x + vote.offset.x, at.y + vote.offset.y};
    if (!map_->contains(cell)) continue;
    const MapCell& here = (*map_)[cell];
    if (here.heat_match <= 0) continue;
    const float explained = here.heat_match * here.heat_match / here.heat_weight;
    if (explained <= best_explained) continue;
    best_explained = explained;
    best = {map_->center(cell), here.heat_match / here.heat_weight};
  }
  return best;
}

}  // namespace robosim
