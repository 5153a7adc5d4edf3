#include "world/world.h"

#include <cmath>

namespace robosim {

Solid Body::solid() const {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    return {Circle{{world_from_body.x, world_from_body.y}, cylinder->radius_m}, heights()};
  }
  const auto& cube = std::get<Cube>(shape);
  return {OrientedBox::from(world_from_body, cube.length_m, cube.width_m), heights()};
}

double Body::coveringRadius() const {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return cylinder->radius_m;
  const auto& cube = std::get<Cube>(shape);
  return std::hypot(cube.length_m, cube.width_m) / 2;
}

std::vector<Solid> stationarySolids(const World& world) {
  std::vector<Solid> solids;
  solids.reserve(world.objects.size());
  for (const auto& object : world.objects) solids.push_back(object.body.solid());
  for (const auto& map : world.maps) addSolids(map.plan, map.world_from_map, map.heights(), solids);
  return solids;
}

}  // namespace robosim
