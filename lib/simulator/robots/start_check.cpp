#include "robots/start_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include <mrpt/core/format.h>

#include "base/xml_element.h"
#include "geometry/scene.h"
#include "world/map_reader.h"

namespace robosim {
namespace {

/// Hash grid of the robots checked so far, by the cell of their centres. A cell is as wide as the widest robot, so
/// overlapping robots are in the same cell or one of the eight neighbours.
class CheckedRobots {
 public:
  explicit CheckedRobots(const std::vector<RobotStart>& robots) : robots_(robots) {
    for (const auto& robot : robots) cell_m_ = std::max(cell_m_, 2 * robot.disc.radius_m);
  }

  void add(std::size_t i) { cells_[key(robots_[i], 0, 0)].push_back(i); }

  /// Index of a robot that overlaps robot i; nullopt when none does.
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
  /// Hash collisions cost a comparison, but do not affect the result.
  std::uint64_t key(const RobotStart& robot, int column, int row) const {
    const auto x = static_cast<std::int64_t>(std::floor(robot.disc.center.x / cell_m_)) + column;
    const auto y = static_cast<std::int64_t>(std::floor(robot.disc.center.y / cell_m_)) + row;
    return static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(y);
  }

  const std::vector<RobotStart>& robots_;
  double cell_m_ = 1e-3;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// For each robot, the solids that it may overlap, in ascending order. The robots are indexed and queried with each
/// solid, because a map may have millions of solids, of which few are near a robot.
std::vector<std::vector<std::size_t>> solidsNear(const std::vector<RobotStart>& robots,
                                                 const std::vector<Solid>& solids, const Bounds2D& world_bounds) {
  Scene scene({}, robots.size(), world_bounds);
  for (std::size_t i = 0; i < robots.size(); ++i) scene.place(i, {robots[i].disc, robots[i].heights});
  scene.freeze();
  std::vector<std::vector<std::size_t>> near(robots.size());
  std::vector<BodyId> reached;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    reached.clear();
    scene.findBodies(boundsOf(solids[i].outline), reached);
    for (const auto robot : reached) near[scene.movingIndex(robot)].push_back(i);
  }
  return near;
}

/// Map that a solid of startSolids() belongs to; null for an object's.
const WorldMap* mapWith(const World& world, std::size_t solid) {
  if (solid < world.objects.size()) return nullptr;
  solid -= world.objects.size();
  for (const auto& map : world.maps) {
    if (map.isFloor()) continue;
    const std::size_t solids = map.plan.occupied.size() + map.plan.boxes.size();
    if (solid < solids) return &map;
    solid -= solids;
  }
  return nullptr;
}

std::string placeText(const mrpt::math::TPoint2D& at) {
  const auto text = [](double at_m) { return toText(std::round(at_m * 1000) / 1000 + 0.0); };
  return "at (" + text(at.x) + ", " + text(at.y) + ") m";
}

std::string placeOf(const RobotStart& robot) { return placeText(robot.disc.center); }

/// Note for a box-shaped robot whose box does not overlap the solid.
std::string discNote(const RobotStart& robot, const Solid& solid) {
  if (std::holds_alternative<Circle>(robot.outline) || overlap({robot.outline, robot.heights}, solid)) return "";
  return mrpt::format(" (its box does not, but moves are authorised for the disc of %.3f m radius around it)",
                      robot.disc.radius_m);
}

/// "of line 5", or "of line 5 of FILE" when this is another file than that of the reported line.
std::string lineText(const World& world, const SourceLine& line, const SourceLine& reported,
                     const std::string& world_file) {
  if (line.number == 0) return "";  // of a map, or a world of Stage
  const std::string text = " of line " + std::to_string(line.number);
  return line.file == reported.file ? text : text + " of " + world.fileOf(line, world_file);
}

/// The disc shrunk by the map's seam, so that a disc that only touches a wall does not overlap it.
Circle withoutSeam(const Circle& disc, const WorldMap& map) {
  return {disc.center, disc.radius_m - 2 * computeSeam(map.plan, map.world_from_map)};
}

std::string placeOf(const WorldObject& object) {
  const auto& pose = object.body.world_from_body;
  return placeText({pose.x, pose.y});
}

}  // namespace

void checkMovableObjects(const World& world, const std::string& world_file, ErrorList& errors) {
  // Doors may be in walls.
  const auto is_free = [](const WorldObject& object) { return object.movable || object.walker; };
  if (std::none_of(world.objects.begin(), world.objects.end(), is_free)) return;
  const std::vector<Solid> solids = startSolids(world);
  const Scene scene(solids, 0, world.bounds);
  std::vector<BodyId> near;
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const WorldObject& object = world.objects[i];
    if (!is_free(object)) continue;
    const auto report = [&](const std::string& fault) {
      errors.add(world.fileOf(object.line, world_file), object.line.number,
                 (object.walker ? "the walker '" : "the movable object '") + object.name + "' " + placeOf(object) +
                     " " + fault);
    };
    const Bounds2D area = boundsOf(solids[i].outline);
    if (!world.bounds.covers(area)) {
      report("stands outside the surface, or reaches over its edge; move it inside, or widen the surface's <size>");
    }
    near.clear();
    scene.findBodies(area, near);
    for (const BodyId body : near) {
      const auto other = static_cast<std::size_t>(body);
      if (other == i || !overlap(solids[i], solids[other])) continue;
      if (const WorldMap* map = mapWith(world, other)) {
        report("overlaps an obstacle of the map '" + map->file + "'; move the object");
        break;
      }
      const WorldObject& with = world.objects[other];
      if (is_free(with) && other < i) continue;  // reported with that one
      report("overlaps the object '" + with.name + "'" + lineText(world, with.line, object.line, world_file) +
             "; move one of them");
    }
  }
}

void checkStarts(const World& world, const std::vector<RobotStart>& robots, const std::string& world_file,
                 ErrorList& errors) {
  const std::vector<Solid> solids = startSolids(world);
  const auto solids_near = solidsNear(robots, solids, world.bounds);
  CheckedRobots checked(robots);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const RobotStart& robot = robots[i];
    const auto report = [&](const std::string& fault) {
      errors.add(world.fileOf(robot.line, world_file), robot.line.number,
                 "robot '" + robot.name + "' " + placeOf(robot) + " " + fault);
    };
    const auto line_text = [&](const SourceLine& line) { return lineText(world, line, robot.line, world_file); };
    if (!world.bounds.covers(boundsOf(robot.disc))) {
      report(std::string("stands outside the surface, or reaches over its edge; move it inside") +
             (isMapFile(world_file) ? "" : ", or widen the surface's <size>"));
      continue;
    }
    const WorldMap* reported = nullptr;
    for (const auto index : solids_near[i]) {
      const WorldMap* map = mapWith(world, index);
      if (map == reported && reported) continue;
      const Circle disc = map ? withoutSeam(robot.disc, *map) : robot.disc;
      if (!overlap({disc, robot.heights}, solids[index])) continue;
      if (map) {
        reported = map;
        report("overlaps an obstacle of the map '" + map->file + "'" + line_text(map->line) +
               discNote(robot, solids[index]) + "; move the robot");
        continue;
      }
      const WorldObject& object = world.objects[index];
      report("overlaps the object '" + object.name + "'" + line_text(object.line) + discNote(robot, solids[index]) +
             "; move one of them");
    }
    if (const auto other = checked.overlapping(i)) {
      report("overlaps the robot '" + robots[*other].name + "'" + line_text(robots[*other].line) +
             discNote(robot, {robots[*other].outline, robots[*other].heights}) + "; move one of them");
    }
    checked.add(i);
  }
}

}  // namespace robosim
