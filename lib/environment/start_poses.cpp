#include "environment/start_poses.h"

#include <algorithm>
#include <cmath>

#include "base/error_list.h"
#include "base/random.h"
#include "geometry/shapes/path.h"
#include "robots/free_space.h"

namespace robosim {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

RandomStarts::RandomStarts(const World& world, const Fleet& fleet)
    : world_name_(world.name), robots_(fleet.robots.size()) {
  if (fleet.robots.empty()) return;
  HeightSpan heights = fleet.robots.front().body.heights();
  std::vector<TPoint2D> starts;
  for (const auto& robot : fleet.robots) {
    radius_m_ = std::max(radius_m_, robot.info.radius_m);
    heights.z_min_m = std::min(heights.z_min_m, robot.body.heights().z_min_m);
    heights.z_max_m = std::max(heights.z_max_m, robot.body.heights().z_max_m);
    starts.emplace_back(robot.world_from_start.x, robot.world_from_start.y);
  }
  const FreeSpace raster(world, radius_m_, heights);
  for (const auto cell : raster.reachableFrom(starts)) places_.push_back(raster.place(cell));
}

std::vector<TPose2D> RandomStarts::draw(std::uint64_t seed) const {
  Rng rng(seed, RandomPurpose::start_pose);
  std::vector<TPoint2D> free_places = places_;
  std::vector<TPose2D> starts;
  while (starts.size() < robots_) {
    if (free_places.empty()) {
      throw ConfigError("world '" + world_name_ + "': there is not enough space to shuffle " + std::to_string(robots_) +
                        " robots; use fewer robots or a larger world");
    }
    const std::size_t draw = rng.below(static_cast<std::uint32_t>(free_places.size()));
    const TPoint2D place = free_places[draw];
    free_places[draw] = free_places.back();
    free_places.pop_back();
    const bool is_clear = std::none_of(starts.begin(), starts.end(), [&](const TPose2D& other) {
      return (TPoint2D(other.x, other.y) - place).norm() < 2 * radius_m_ + kContactGap_m;
    });
    if (is_clear) starts.emplace_back(place.x, place.y, rng.uniform(-M_PI, M_PI));
  }
  return starts;
}

void setStartPoses(Fleet& fleet, std::span<const TPose2D> starts) {
  for (std::size_t i = 0; i < starts.size(); ++i) {
    fleet.robots[i].world_from_start = starts[i];
    fleet.robots[i].body.world_from_body = starts[i];
  }
}

void shuffleStartPoses(const World& world, Fleet& fleet, std::uint64_t seed) {
  setStartPoses(fleet, RandomStarts(world, fleet).draw(seed));
}

}  // namespace robosim
