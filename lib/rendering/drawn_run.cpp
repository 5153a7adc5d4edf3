#include "rendering/drawn_run.h"

#include <algorithm>

namespace robosim {

Bounds2D areaOf(const World& world, const DrawnRun& run) {
  Bounds2D area = world.bounds;
  const auto include = [&](const Bounds2D& b) {
    area = {std::min(area.x_min, b.x_min), std::max(area.x_max, b.x_max), std::min(area.y_min, b.y_min),
            std::max(area.y_max, b.y_max)};
  };
  for (const auto& object : world.objects) include(boundsOf(object.body.solid().outline));
  for (const auto& map : world.maps) include(boundsOf(map.plan, map.world_from_map));
  for (const auto& path : run.paths) {
    for (const auto& point : path) {
      if (!isGap(point)) include({point.x, point.x, point.y, point.y});
    }
  }
  return area;
}

}  // namespace robosim
