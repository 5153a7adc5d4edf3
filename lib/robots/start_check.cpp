#include "robots/start_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "geometry/scene.h"

namespace robosim {
namespace {

bool isWithin(const Circle& disc, const Bounds2D& bounds) {
  return disc.center.x - disc.radius_m >= bounds.x_min && disc.center.x + disc.radius_m <= bounds.x_max &&
         disc.center.y - disc.radius_m >= bounds.y_min && disc.center.y + disc.radius_m <= bounds.y_max;
}

/// Robots seen so far, by the square cell of their centres. A cell is as wide as the widest robot, so whatever overlaps
/// a robot has its centre in the robot's cell or in one of the eight around it.
class RobotsSoFar {
 public:
  explicit RobotsSoFar(const std::vector<RobotStart>& robots) : robots_(robots) {
    for (const auto& robot : robots) cell_m_ = std::max(cell_m_, 2 * robot.disc.radius_m);
  }

  void add(std::size_t i) { cells_[key(robots_[i], 0, 0)].push_back(i); }

  /// One that overlaps robot i; nullopt when none does.
  std::optional<std::size_t> overlapping(std::size_t i) const {
    const Solid solid{robots_[i].disc, robots_[i].heights};
    for (int column = -1; column <= 1; ++column) {
      for (int row = -1; row <= 1; ++row) {
        const auto cell = cells_.find(key(robots_[i], column, row));
        if (cell == cells_.end()) continue;
        for (const auto other : cell->second) {
          if (overlap(solid, {robots_[other].disc, robots_[other].heights})) return other;
        }
      }
    }
    return std::nullopt;
  }

 private:
  /// Cells may share a key by chance: that costs a comparison, no more.
  std::uint64_t key(const RobotStart& robot, int column, int row) const {
    const auto x = static_cast<std::int64_t>(std::floor(robot.disc.center.x / cell_m_)) + column;
    const auto y = static_cast<std::int64_t>(std::floor(robot.disc.center.y / cell_m_)) + row;
    return static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(y);
  }

  const std::vector<RobotStart>& robots_;
  double cell_m_ = 1e-3;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// Of the solids, those that each robot may reach to, in ascending order. Asked of the solids, not of the robots: a map
/// has millions of them, few are near a robot, and an index of them all would be made for nothing else.
std::vector<std::vector<std::size_t>> solidsNear(const std::vector<RobotStart>& robots,
                                                 const std::vector<Solid>& solids, const Bounds2D& world_bounds) {
  Scene scene({}, robots.size(), world_bounds);
  for (std::size_t i = 0; i < robots.size(); ++i) scene.place(i, {robots[i].disc, robots[i].heights});
  scene.freeze();
  std::vector<std::vector<std::size_t>> near(robots.size());
  std::vector<BodyId> reached;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    reached.clear();
    scene.movingNear(boundsOf(solids[i].outline), reached);
    for (const auto robot : reached) near[scene.movingIndex(robot)].push_back(i);
  }
  return near;
}

/// The map that a solid of stationarySolids() comes from; null for an object's.
const WorldMap* mapWith(const World& world, std::size_t solid) {
  if (solid < world.objects.size()) return nullptr;
  solid -= world.objects.size();
  for (const auto& map : world.maps) {
    const std::size_t solids = map.plan.occupied.size() + map.plan.boxes.size();
    if (solid < solids) return &map;
    solid -= solids;
  }
  return nullptr;
}

/// A disc that touches what a map has, which reaches a little over its edges, and no more than touches it.
Circle withoutSeam(const Circle& disc, const WorldMap& map) {
  return {disc.center, disc.radius_m - 2 * seamOf(map.plan, map.world_from_map)};
}

}  // namespace

void checkStarts(const World& world, const std::vector<RobotStart>& robots, const std::string& world_file,
                 ErrorList& errors) {
  const std::vector<Solid> solids = stationarySolids(world);
  const auto solids_near = solidsNear(robots, solids, world.bounds);
  RobotsSoFar so_far(robots);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const RobotStart& robot = robots[i];
    const auto report = [&](const std::string& fault) {
      errors.add(world_file, robot.line, "robot '" + robot.name + "' " + fault);
    };
    if (!isWithin(robot.disc, world.bounds)) {
      report("stands outside the surface, or reaches over its edge; move it inside, or widen the surface's <size>");
      continue;
    }
    const WorldMap* met = nullptr;
    for (const auto index : solids_near[i]) {
      const WorldMap* map = mapWith(world, index);
      if (map == met && met) continue;
      const Circle disc = map ? withoutSeam(robot.disc, *map) : robot.disc;
      if (!overlap({disc, robot.heights}, solids[index])) continue;
      if (map) {
        met = map;
        report("overlaps what the map '" + map->file + "' of line " + std::to_string(map->line.number) +
               " has there; move the robot");
        continue;
      }
      const WorldObject& object = world.objects[index];
      report("overlaps the object '" + object.name + "' of line " + std::to_string(object.line.number) +
             "; move one of them");
    }
    if (const auto other = so_far.overlapping(i)) {
      report("overlaps the robot '" + robots[*other].name + "' of line " + std::to_string(robots[*other].line) +
             "; move one of them");
    }
    so_far.add(i);
  }
}

}  // namespace robosim
