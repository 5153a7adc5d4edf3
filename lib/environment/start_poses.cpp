#include "environment/start_poses.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "geometry/scene.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// The places of a raster where a disc touches nothing stationary, and which of them hang together.
class Raster {
 public:
  Raster(const World& world, double radius_m, const HeightSpan& heights)
      : bounds_(world.bounds),
        cell_m_(radius_m / 2),
        columns_(count(bounds_.x_max - bounds_.x_min)),
        rows_(count(bounds_.y_max - bounds_.y_min)),
        free_(columns_ * rows_, 1) {
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const TPoint2D p = place(i);
      const double to_rim =
          std::min({p.x - bounds_.x_min, bounds_.x_max - p.x, p.y - bounds_.y_min, bounds_.y_max - p.y});
      if (to_rim < radius_m) free_[i] = 0;
    }
    for (const auto& solid : stationarySolids(world)) {
      if (solid.heights.overlaps(heights)) block(solid.outline, radius_m);
    }
  }

  TPoint2D place(std::size_t cell) const {
    return {bounds_.x_min + (static_cast<double>(cell % columns_) + 0.5) * cell_m_,
            bounds_.y_min + (static_cast<double>(cell / columns_) + 0.5) * cell_m_};
  }

  /// All free cells that can be reached from free cells near the starts, in ascending order.
  std::vector<std::size_t> reachableFrom(const std::vector<TPoint2D>& starts) const {
    std::vector<std::uint8_t> seen(free_.size(), 0);
    std::vector<std::size_t> reached;
    const auto visit = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
      if (column < 0 || row < 0 || column >= static_cast<std::ptrdiff_t>(columns_) ||
          row >= static_cast<std::ptrdiff_t>(rows_)) {
        return;
      }
      const auto cell = static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
      if (!free_[cell] || seen[cell]) return;
      seen[cell] = 1;
      reached.push_back(cell);
    };
    for (const auto& start : starts) {
      const auto column = static_cast<std::ptrdiff_t>((start.x - bounds_.x_min) / cell_m_);
      const auto row = static_cast<std::ptrdiff_t>((start.y - bounds_.y_min) / cell_m_);
      for (std::ptrdiff_t dy = -1; dy <= 1; ++dy) {
        for (std::ptrdiff_t dx = -1; dx <= 1; ++dx) visit(column + dx, row + dy);
      }
    }
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const auto column = static_cast<std::ptrdiff_t>(reached[next] % columns_);
      const auto row = static_cast<std::ptrdiff_t>(reached[next] / columns_);
      visit(column - 1, row);
      visit(column + 1, row);
      visit(column, row - 1);
      visit(column, row + 1);
    }
    std::sort(reached.begin(), reached.end());
    return reached;
  }

 private:
  std::size_t count(double extent_m) const {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(extent_m / cell_m_)));
  }

  void block(const Outline& outline, double radius_m) {
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

  Bounds2D bounds_;
  double cell_m_;
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> free_;
};

}  // namespace

void shuffleStartPoses(const World& world, Fleet& fleet, std::uint64_t seed) {
  if (fleet.robots.empty()) return;
  double radius_m = 0;
  HeightSpan heights = fleet.robots.front().body.heights();
  std::vector<TPoint2D> starts;
  for (const auto& robot : fleet.robots) {
    radius_m = std::max(radius_m, robot.info.radius_m);
    heights.z_min_m = std::min(heights.z_min_m, robot.body.heights().z_min_m);
    heights.z_max_m = std::max(heights.z_max_m, robot.body.heights().z_max_m);
    starts.emplace_back(robot.world_from_start.x, robot.world_from_start.y);
  }
  const double cells =
      4 * (world.bounds.x_max - world.bounds.x_min) / radius_m * ((world.bounds.y_max - world.bounds.y_min) / radius_m);
  if (!(cells < 1e8)) {
    throw ConfigError("world '" + world.name +
                      "': is too large for its robots to shuffle their starts; keep its sides below 5,000 robot radii");
  }
  const Raster raster(world, radius_m, heights);
  std::vector<std::size_t> free_cells = raster.reachableFrom(starts);

  Rng rng(seed, RandomPurpose::start_pose);
  std::vector<TPoint2D> taken;
  for (auto& robot : fleet.robots) {
    while (!free_cells.empty()) {
      const std::size_t draw = rng.below(static_cast<std::uint32_t>(free_cells.size()));
      const TPoint2D place = raster.place(free_cells[draw]);
      free_cells[draw] = free_cells.back();
      free_cells.pop_back();
      const bool clear = std::none_of(taken.begin(), taken.end(), [&](const TPoint2D& other) {
        return (other - place).norm() < 2 * radius_m + kContactGap_m;
      });
      if (!clear) continue;
      taken.push_back(place);
      robot.world_from_start = {place.x, place.y, rng.uniform(-M_PI, M_PI)};
      robot.body.world_from_body = robot.world_from_start;
      break;
    }
    if (taken.size() < static_cast<std::size_t>(&robot - fleet.robots.data()) + 1) {
      throw ConfigError("world '" + world.name + "': there is no room to shuffle " +
                        std::to_string(fleet.robots.size()) + " robots; use fewer robots or a larger world");
    }
  }
}

}  // namespace robosim
