#include "world/world.h"

#include <filesystem>

namespace robosim {

std::string Scatter::nameOf(int number) const {
  return std::visit([](const auto& it) { return it.name; }, copied) + std::to_string(number);
}

std::string Scatter::neighbourOf(int number) const {
  const auto* robot = std::get_if<RobotPlacement>(&copied);
  if (!robot || !has_neighbour_ring) return robot ? robot->neighbour : "";
  return count == 1 ? "" : nameOf(number % count + 1);
}

std::string World::fileOf(const SourceLine& line, const std::string& world_file) const {
  if (line.file == 0) return world_file;
  const auto& included_name = origin.included[static_cast<std::size_t>(line.file - 1)];
  return (std::filesystem::path(world_file).parent_path() / included_name).string();
}

std::vector<Solid> unknownSolids(const WorldMap& map) {
  if (map.isFloor()) return {};
  FloorPlan plan = map.plan;
  plan.boxes.clear();
  plan.occupied = std::move(plan.unknown);
  std::vector<Solid> boxes;
  addSolids(plan, map.world_from_map, map.heights(), boxes);
  return boxes;
}

namespace {

template <typename Select>
std::vector<Solid> solidsOf(const std::vector<WorldObject>& objects, const std::vector<WorldMap>& maps,
                            const Select& select) {
  std::vector<Solid> solids;
  solids.reserve(objects.size());
  for (const auto& object : objects) {
    if (select(object)) solids.push_back(object.body.solid());
  }
  for (const auto& map : maps) {
    if (!map.isFloor()) addSolids(map.plan, map.world_from_map, map.heights(), solids);
  }
  return solids;
}

}  // namespace

std::vector<Solid> startSolids(const World& world) {
  return solidsOf(world.objects, world.maps, [](const WorldObject&) { return true; });
}

std::vector<Solid> stationarySolids(const std::vector<WorldObject>& objects, const std::vector<WorldMap>& maps) {
  return solidsOf(objects, maps, [](const WorldObject& object) { return object.isStationary(); });
}

}  // namespace robosim
