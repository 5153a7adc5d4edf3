#include "environment/start_poses.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error_list.h"
#include "base/random.h"
#include "geometry/shapes/path.h"
#include "robots/free_space.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

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
  const FreeSpace raster(world, radius_m, heights);
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
      throw ConfigError("world '" + world.name + "': there is not enough space to shuffle " +
                        std::to_string(fleet.robots.size()) + " robots; use fewer robots or a larger world");
    }
  }
}

}  // namespace robosim
