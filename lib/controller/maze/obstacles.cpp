#include "maze/obstacles.h"

#include "base/portable_math.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr int kReach_cells = 24;  // farther echoes are ignored, to save time
constexpr int kHit = 4;
constexpr int kUnsureHit = 1;
constexpr int kOccupied = Obstacles::kLearned;     // reached by one echo
constexpr int kSure = 8;                           // requires several echoes
constexpr int kEvidenceMax = Obstacles::kCertain;  // bounds the empty observations that free a cell
constexpr int kBumpsMax = 3;          // a cell with as many is occupied although range sensors measure free space
constexpr double kBerth_radii = 0.5;  // clearance beyond the body

std::vector<Cell> offsetsWithin(double distance_cells) {
  std::vector<Cell> offsets;
  const int reach = static_cast<int>(distance_cells);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      if (portable::hypot(x, y) < distance_cells) offsets.push_back({x, y});
    }
  }
  return offsets;
}

}  // namespace

Obstacles::Obstacles(MazeMap& map, double robot_radius_m)
    : map_(&map),
      radius_m_(robot_radius_m),
      near_(offsetsWithin(robot_radius_m / map.cellSize())),
      close_(offsetsWithin(robot_radius_m * (1 + kBerth_radii) / map.cellSize() + 1)) {}

void Obstacles::look(const mrpt::math::TPose2D& start_from_robot, const SensorInfo& sensor, const Echoes& echoes,
                     std::size_t stride) {
  const auto [sin_phi, cos_phi] = portable::sincos(start_from_robot.phi);
  const auto to_start = [&, cos_phi = cos_phi, sin_phi = sin_phi](double x, double y) {
    return mrpt::math::TPoint2D(start_from_robot.x + cos_phi * x - sin_phi * y,
                                start_from_robot.y + sin_phi * x + cos_phi * y);
  };
  for (std::size_t i = 0; i < echoes.size(); i += stride) {
    const auto& mount = sensor.beams[i].robot_from_beam;
    const mrpt::math::TPoint2D from = to_start(mount.x, mount.y);
    const mrpt::math::TPoint2D ray = to_start(echoes[i].point_m.x, echoes[i].point_m.y) - from;
    trace(from, from + ray, isEcho(sensor, echoes[i]));
  }
}

void Obstacles::trace(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, bool is_echo, bool is_sure) {
  const double cell_m = map_->cellSize();
  const double reach_m = kReach_cells * cell_m;
  const mrpt::math::TPoint2D ray = to - from;
  const double length = ray.norm();
  if (length <= 0) return;
  const mrpt::math::TPoint2D step = ray * (cell_m / length);
  const bool hit = is_echo && length < reach_m;
  const int free_cells = static_cast<int>(std::min(length, reach_m) / cell_m - (hit ? 0.5 : 0));
  mrpt::math::TPoint2D at = from + step * 0.5;
  for (int k = 0; k < free_cells; ++k, at += step) seeFree(map_->cellAt(at));
  // Slightly beyond the surface, so that a surface on the border of two cells always maps to the same cell.
  if (hit) add(map_->cellAt(from + ray + step * 0.2), is_sure ? kHit : kUnsureHit);
}

void Obstacles::clearUnder(const mrpt::math::TPoint2D& robot) {
  const Cell at = map_->cellAt(robot);
  for (const Cell& offset : near_) {
    const Cell cell{at.x + offset.x, at.y + offset.y};
    if ((map_->center(cell) - robot).norm() < 0.6 * radius_m_) clear(cell);
  }
}

void Obstacles::bump(const mrpt::math::TPoint2D& place) {
  const Cell cell = map_->cellAt(place);
  add(cell, kSure - 1);
  if (!map_->contains(cell)) return;
  MapCell& here = (*map_)[cell];
  here.bumps = static_cast<std::uint8_t>(std::min(here.bumps + 1, kBumpsMax)) & 3u;
}

void Obstacles::learn(const Cell& cell, int evidence) {
  const int margin = close_.back().y;
  map_->cover({cell.x - margin, cell.y - margin}, {cell.x + margin, cell.y + margin});
  if (!map_->contains(cell)) return;
  const int known = (*map_)[cell].evidence;
  if (known < evidence) add(cell, evidence - known);
}

int Obstacles::reach() const {
  // All neighbours must exist when an obstacle is counted, to keep the counts correct when it is removed.
  return kReach_cells + 1 + close_.back().y;
}

void Obstacles::removeUncertain() {
  for (std::size_t i = 0; i < map_->size(); ++i) {
    const MapCell& cell = map_->at(i);
    if (cell.evidence > 0 && (cell.evidence < kSure || cell.bumps == kBumpsMax)) clear(map_->cell(i));
  }
}

void Obstacles::seeFree(const Cell& cell) {
  if (!map_->contains(cell)) return;
  const MapCell& here = (*map_)[cell];
  if (here.evidence > 0 && here.bumps < kBumpsMax) add(cell, -1);
}

void Obstacles::clear(const Cell& cell) {
  add(cell, -kEvidenceMax);
  if (map_->contains(cell)) (*map_)[cell].bumps = 0;
}

void Obstacles::add(const Cell& cell, int evidence) {
  if (!map_->contains(cell)) return;
  MapCell& here = (*map_)[cell];
  const bool was_occupied = here.evidence >= kOccupied;
  here.evidence = static_cast<std::uint8_t>(std::clamp(here.evidence + evidence, 0, kEvidenceMax));
  const bool is_occupied = here.evidence >= kOccupied;
  if (is_occupied != was_occupied) occupy(cell, is_occupied ? 1 : -1);
}

void Obstacles::occupy(const Cell& cell, int by) {
  ++changes_;
  const auto count = [&](const std::vector<Cell>& offsets, std::uint8_t MapCell::*counter) {
    for (const Cell& offset : offsets) {
      const Cell neighbour{cell.x + offset.x, cell.y + offset.y};
      if (!map_->contains(neighbour)) continue;
      auto& value = (*map_)[neighbour].*counter;
      value = static_cast<std::uint8_t>(value + by);
    }
  };
  count(near_, &MapCell::walls_near);
  count(close_, &MapCell::walls_close);
}

}  // namespace robosim
