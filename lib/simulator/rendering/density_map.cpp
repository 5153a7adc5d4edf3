#include "rendering/density_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <mrpt/core/format.h>

#include "rendering/ground_view.h"
#include "rendering/path_gap.h"
#include "rendering/snapshot_run.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// The smallest of 1, 2, 5, 10, … and of 0.5, 0.2, 0.1, … that is not below `limit`, which is > 0.
double roundUp(double limit) {
  constexpr double kRounding = 1 + 1e-9;
  const double below = roundLengthUpTo(limit * kRounding);
  if (below * kRounding >= limit) return below;
  for (const double factor : {2.0, 2.5}) {
    const double next = roundLengthUpTo(below * factor * kRounding);
    if (next > below * kRounding) return next;
  }
  return 2 * below;
}

}  // namespace

DensityMap::DensityMap(Quantity quantity, const Bounds2D& area, double cell_m)
    : quantity_(quantity),
      low_(area.x_min, area.y_min),
      cell_m_(cell_m),
      columns_(std::max(1, static_cast<int>(std::ceil((area.x_max - area.x_min) / cell_m - 1e-9)))),
      rows_(std::max(1, static_cast<int>(std::ceil((area.y_max - area.y_min) / cell_m - 1e-9)))),
      counts_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

double DensityMap::cellSide(const Bounds2D& area, std::size_t robots, double radius_max_m) {
  constexpr double kMaxCells = 150, kMinCells = 8, kRobotsPerCell = 2;
  const double width_m = area.x_max - area.x_min, height_m = area.y_max - area.y_min;
  const double longer_m = std::max({width_m, height_m, 1e-3});
  const double wanted_m =
      robots == 0 ? 0 : std::sqrt(kRobotsPerCell * width_m * height_m / static_cast<double>(robots));
  const double smallest_m = std::max(longer_m / kMaxCells, 2 * radius_max_m);
  const double side_m = roundUp(std::max(smallest_m, wanted_m));
  return side_m <= longer_m / kMinCells ? side_m : std::max(roundUp(smallest_m), roundLengthUpTo(longer_m / kMinCells));
}

std::optional<std::size_t> DensityMap::cellAt(const TPoint2D& at) const {
  const double column = std::floor((at.x - low_.x) / cell_m_), row = std::floor((at.y - low_.y) / cell_m_);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return std::nullopt;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
}

void DensityMap::addRobot(const TPoint2D& at) {
  if (const auto cell = cellAt(at)) ++counts_[*cell];
}

void DensityMap::addPath(std::span<const TPoint2D> path) {
  std::optional<std::size_t> cell;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (isGap(path[i])) {
      cell.reset();
    } else if (i == 0 || isGap(path[i - 1])) {
      cell = cellAt(path[i]);
      if (cell) ++counts_[*cell];
    } else {
      addPiece(path[i - 1], path[i], cell);
    }
  }
}

/// Visits the cells between the crossings of the piece with the grid's lines, in their order.
/// @param cell where the piece begins; set to where it ends
void DensityMap::addPiece(const TPoint2D& from, const TPoint2D& to, std::optional<std::size_t>& cell) {
  if (cellAt(to) == cell && cell) return;  // cells are convex
  std::vector<double> crossings;           // as shares of the piece
  const auto add_lines = [&](double a, double b, double low) {
    const double first = std::ceil((std::min(a, b) - low) / cell_m_),
                 last = std::floor((std::max(a, b) - low) / cell_m_);
    for (double line = first; line <= last; ++line) crossings.push_back((low + line * cell_m_ - a) / (b - a));
  };
  if (from.x != to.x) add_lines(from.x, to.x, low_.x);
  if (from.y != to.y) add_lines(from.y, to.y, low_.y);
  crossings.push_back(1);
  std::sort(crossings.begin(), crossings.end());
  double before = 0;
  for (const double share : crossings) {
    if (share <= before) continue;
    const auto next = cellAt(from + (to - from) * ((before + share) / 2));
    if (next && next != cell) ++counts_[*next];
    cell = next;
    before = share;
  }
}

double DensityMap::perSquareMetre(int column, int row) const {
  return counts_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)] /
         (cell_m_ * cell_m_);
}

double DensityMap::top() const {
  std::vector<std::uint32_t> counts;
  std::copy_if(counts_.begin(), counts_.end(), std::back_inserter(counts), [](auto count) { return count > 0; });
  if (counts.empty()) return roundUp(1 / (cell_m_ * cell_m_));
  std::sort(counts.begin(), counts.end());
  return roundUp(counts[counts.size() - 1 - counts.size() / 100] / (cell_m_ * cell_m_));
}

int DensityMap::levelOf(double per_square_metre, double top) {
  if (per_square_metre <= 0) return 0;
  return std::clamp(static_cast<int>(std::ceil(kLevels * per_square_metre / top - 1e-9)), 1, kLevels);
}

cv::Mat DensityMap::levels() const {
  cv::Mat levels(rows_, columns_, CV_8U);
  const double top = this->top();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      levels.at<std::uint8_t>(rows_ - 1 - row, column) =
          static_cast<std::uint8_t>(levelOf(perSquareMetre(column, row), top));
    }
  }
  return levels;
}

std::string DensityMap::legend() const {
  const double top = this->top();
  const bool exceeds = std::any_of(counts_.begin(), counts_.end(),
                                   [&](auto count) { return count / (cell_m_ * cell_m_) > top * (1 + 1e-9); });
  return mrpt::format("0 to %g%s %s/m²", top, exceeds ? "+" : "", quantity_ == Quantity::robots ? "robots" : "visits");
}

Color DensityMap::colorOf(int level) {
  // From pale yellow by green to dark blue: brightness falls evenly.
  static constexpr Color kAnchors[] = {
      {0.99f, 0.93f, 0.66f}, {0.53f, 0.80f, 0.62f}, {0.15f, 0.52f, 0.60f}, {0.11f, 0.15f, 0.37f}};
  constexpr int kPieces = static_cast<int>(std::size(kAnchors)) - 1;
  const float along = kPieces * static_cast<float>(level - 1) / (kLevels - 1);
  const int piece = std::min(kPieces - 1, static_cast<int>(along));
  return mix(kAnchors[piece], kAnchors[piece + 1], along - static_cast<float>(piece));
}

std::optional<DensityMap> densityOf(const ViewLayers& layers, const World& world, const Fleet& fleet,
                                    std::span<const std::optional<TPoint2D>> at,
                                    std::span<const std::vector<TPoint2D>> paths) {
  if (!layers.density && !layers.visits) return std::nullopt;
  double radius_max_m = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    if (!layers.shows(i)) continue;
    radius_max_m = std::max(radius_max_m, fleet.robots[i].info.radius_m);
    if (i < at.size() && at[i]) ++count;
  }
  const auto quantity = layers.density ? DensityMap::Quantity::robots : DensityMap::Quantity::visits;
  DensityMap map(
      quantity, world.bounds,
      DensityMap::cellSide(world.bounds, layers.density ? std::max<std::size_t>(1, count) : 0, radius_max_m));
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    if (!layers.shows(i)) continue;
    if (layers.density && i < at.size() && at[i]) map.addRobot(*at[i]);
    if (!layers.visits || i >= paths.size()) continue;
    std::vector<TPoint2D> path = paths[i];
    if (i < at.size() && at[i] && !path.empty()) path.push_back(*at[i]);  // where the robot is now
    map.addPath(path);
  }
  return map;
}

std::optional<DensityMap> densityOf(const ViewLayers& layers, const World& world, const Fleet& fleet,
                                    const RunSnapshot& snapshot, const RunPaths& paths) {
  if (!layers.density && !layers.visits) return std::nullopt;
  std::vector<std::optional<TPoint2D>> at;
  std::vector<std::vector<TPoint2D>> paths_of_robots;
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    const RobotSnapshot& robot = snapshot.robots[i];
    auto& place = at.emplace_back();
    if (robot.isPresent()) place.emplace(robot.world_from_robot.x, robot.world_from_robot.y);
    if (!layers.visits) continue;
    auto& path = paths_of_robots.emplace_back();
    if (!layers.shows(i)) continue;
    path = drawnPath(i, paths, layers.paths_from_s, snapshot.time_s, robot.isPresent()).points;
  }
  return densityOf(layers, world, fleet, at, paths_of_robots);
}

}  // namespace robosim
