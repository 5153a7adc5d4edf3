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

}  // namespace

void checkStarts(const World& world, const std::vector<RobotStart>& robots, const std::string& world_file,
                 ErrorList& errors) {
  std::vector<Solid> solids;
  for (const auto& object : world.objects) solids.push_back(object.body.solid());
  const Scene objects(std::move(solids), 0, world.bounds);
  RobotsSoFar so_far(robots);
  std::vector<BodyId> near;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const RobotStart& robot = robots[i];
    const auto report = [&](const std::string& fault) {
      errors.add(world_file, robot.line, "robot '" + robot.name + "' " + fault);
    };
    if (!isWithin(robot.disc, world.bounds)) {
      report("stands outside the surface, or reaches over its edge; move it inside, or widen the surface's <size>");
      continue;
    }
    near.clear();
    objects.stationaryNear(boundsOf(robot.disc), near);
    for (const auto body : near) {
      if (!overlap({robot.disc, robot.heights}, objects.solid(body))) continue;
      const WorldObject& object = world.objects[static_cast<std::size_t>(body)];
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
