#include "dynamics/object_mover.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_math.h"
#include "dynamics/sets.h"
#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using With = PushingGroup::Pair::With;

/// More than contacts and rounding need [m].
constexpr double kSlack_m = 10 * kContactGap_m;

TPoint2D startOf(const Path& path) { return {path.world_from_start.x, path.world_from_start.y}; }

}  // namespace

/// Finds what may touch in a step, and divides it into groups. Numbers of bodies are those of the scene's moving
/// solids.
struct ObjectMover::Search {
  const ObjectMover& of;
  const Scene& scene;
  std::span<const Path> paths;
  std::span<const ObjectMotion> objects;
  std::vector<std::uint8_t> robot_moves;  ///< by robot; paths change while groups are computed
  std::vector<DrivenPlan> plans;          ///< by object
  double speed_max_mps = 0;               ///< of all bodies at the start of the step
  double reach_m = 0;                     ///< no object moves farther
  double path_max_m = 0;
  Sets sets;
  std::vector<std::uint8_t> is_member;  ///< by body: an object that may move, or a robot that such a one may block
  std::vector<std::uint32_t> members;   ///< in the order found
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< lower body first; a member, and what it may touch

  Search(const ObjectMover& mover, const Scene& the_scene, double period_s, std::uint64_t seed,
         std::span<const Path> the_paths, std::span<const ObjectMotion> the_objects)
      : of(mover),
        scene(the_scene),
        paths(the_paths),
        objects(the_objects),
        sets(the_paths.size() + the_objects.size()),
        is_member(the_paths.size() + the_objects.size()) {
    for (const auto& path : paths) {
      robot_moves.push_back(path.clippedLength() != 0 ? 1 : 0);
      path_max_m = std::max(path_max_m, std::abs(path.clippedLength()));
      // A clipped robot drives as fast as another, until it stops.
      if (path.clippedLength() != 0) speed_max_mps = std::max(speed_max_mps, std::abs(path.length_m) / period_s);
    }
    if (of.has_driven_) {
      plans = planDriven({scene, of.surface_, of.bodies_, objects, of.robots_, paths, period_s, seed});
      for (const auto& plan : plans) speed_max_mps = std::max(speed_max_mps, plan.way_m / period_s);
    }
    for (std::size_t k = 0; k < objects.size(); ++k) {
      const auto& motion = objects[k];
      if (motion.isAtRest()) continue;
      speed_max_mps = std::max(speed_max_mps, portable::hypot(motion.vx_mps, motion.vy_mps) +
                                                  std::abs(motion.turn_radps) * of.bodies_[k].covering_radius_m);
    }
    speed_max_mps = std::max(speed_max_mps, of.belt_speed_max_mps_);
    // A body that bounces off a heavy one that comes towards it leaves with its own speed and twice the other's.
    speed_max_mps *= 3;
    reach_m = speed_max_mps * period_s + kSlack_m;
  }

  bool isDriven(std::uint32_t body) const { return !isRobot(body) && object(body).isDriven(); }

  std::uint32_t robotCount() const { return static_cast<std::uint32_t>(paths.size()); }
  bool isRobot(std::uint32_t body) const { return body < paths.size(); }
  std::uint32_t bodyOf(std::size_t object) const { return robotCount() + static_cast<std::uint32_t>(object); }
  const MovableBody& object(std::uint32_t body) const { return of.bodies_[body - paths.size()]; }
  bool moves(std::uint32_t robot) const { return robot_moves[robot] != 0; }
  TPoint2D centerOf(std::uint32_t body) const {
    if (isRobot(body)) return startOf(paths[body]);
    const auto& pose = objects[body - paths.size()].world_from_object;
    return {pose.x, pose.y};
  }
  double coverOf(std::uint32_t body) const {
    return isRobot(body) ? of.robots_[body].radius_m : object(body).covering_radius_m;
  }
  const HeightSpan& heightsOf(std::uint32_t body) const {
    return isRobot(body) ? of.robots_[body].heights : object(body).heights;
  }
  /// The farthest that a body may move in this step.
  double reachOf(std::uint32_t body) const { return isRobot(body) ? std::abs(paths[body].clippedLength()) : reach_m; }

  bool isCarried(std::size_t k) const {
    if (of.bodies_[k].isDriven()) return false;
    return std::any_of(of.belts_.begin(), of.belts_.end(),
                       [&](const Belt& belt) { return belt.carries(centerOf(bodyOf(k))); });
  }

  void add(std::uint32_t body) {
    if (std::exchange(is_member[body], 1) == 0) members.push_back(body);
  }

  /// Objects that move or stand on a belt, or that a robot drives against.
  void begin() {
    for (std::size_t k = 0; k < objects.size(); ++k) {
      const bool is_driven_on = !plans.empty() && plans[k].way_m > 0;
      if (is_driven_on || !objects[k].isAtRest() || isCarried(k)) add(bodyOf(k));
    }
    std::vector<std::uint32_t> near;
    for (std::uint32_t r = 0; r < robotCount(); ++r) {
      if (!moves(r)) continue;
      const double from_robot_m = coverOf(r) + reachOf(r) + kSlack_m;
      scene.findMoving(centerOf(r), from_robot_m + of.cover_max_m_, scene.movingCount(), near);
      for (const auto body : near) {
        if (isRobot(body) || !heightsOf(body).overlaps(heightsOf(r))) continue;
        if (isWithin(centerOf(r), centerOf(body), from_robot_m + coverOf(body))) add(body);
      }
    }
  }

  /// Adds what the members may touch, until nothing more is found.
  void grow() {
    std::vector<std::uint32_t> near;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const std::uint32_t body = members[m];
      const double own_m = coverOf(body) + reachOf(body) + kSlack_m;
      const double other_max_m = std::max(of.cover_max_m_ + reach_m, of.radius_max_m_ + path_max_m);
      scene.findMoving(centerOf(body), own_m + other_max_m, scene.movingCount(), near);
      for (const auto other : near) {
        if (other != body && heightsOf(other).overlaps(heightsOf(body))) meet(body, other, own_m + coverOf(other));
      }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

  /// @param touch_m distance of the centres within which the member may touch the other where that is now
  void meet(std::uint32_t member, std::uint32_t other, double touch_m) {
    const bool touches_where_it_is = isWithin(centerOf(member), centerOf(other), touch_m);
    if (isRobot(other) && !moves(other)) return;      // an obstacle (addObstacles())
    if (isDriven(member) && isDriven(other)) return;  // planDriven() has kept them apart; doors may be in walls
    if (!isWithin(centerOf(member), centerOf(other), touch_m + reachOf(other))) return;
    // An object at rest that cannot be touched is no member yet; if it becomes one, it meets this one.
    if (!isRobot(other) && !is_member[other] && !touches_where_it_is) return;
    add(other);
    sets.join(member, other);
    pair(member, other);
  }

  void pair(std::uint32_t a, std::uint32_t b) { pairs.emplace_back(std::min(a, b), std::max(a, b)); }

  /// The bodies of each group, ascending; by the first.
  std::vector<std::vector<std::uint32_t>> groups() {
    std::sort(members.begin(), members.end());
    std::vector<std::uint32_t> group_of(is_member.size(), ~std::uint32_t{0});
    std::vector<std::vector<std::uint32_t>> all;
    for (const auto body : members) {
      auto& group = group_of[sets.of(body)];
      if (group == ~std::uint32_t{0}) {
        group = static_cast<std::uint32_t>(all.size());
        all.emplace_back();
      }
      all[group].push_back(body);
    }
    return all;
  }

  /// @param bodies members, ascending
  PushingGroup groupOf(const std::vector<std::uint32_t>& bodies, std::span<Path> moved_paths,
                       std::span<ObjectMotion> moved_objects) const {
    PushingGroup group;
    group.reach_m = reach_m;
    group.speed_max_mps = speed_max_mps;
    group.belts = of.belts_;
    for (const auto body : bodies) {
      if (isRobot(body)) {
        group.robots.push_back({&of.robots_[body], &moved_paths[body]});
      } else {
        const std::size_t k = body - paths.size();
        group.objects.push_back({&object(body), &moved_objects[k], plans.empty() ? nullptr : &plans[k]});
      }
    }
    const auto robots = static_cast<std::uint32_t>(group.robots.size());
    const auto place = [&](std::uint32_t body) {
      return static_cast<std::uint32_t>(std::lower_bound(bodies.begin(), bodies.end(), body) - bodies.begin());
    };
    std::vector<BodyId> near;
    for (std::uint32_t k = 0; k < group.objects.size(); ++k) addObstacles(bodies[robots + k], k, near, group);
    for (const auto body : bodies) {
      for (auto it = std::lower_bound(pairs.begin(), pairs.end(), std::pair{body, std::uint32_t{0}});
           it != pairs.end() && it->first == body; ++it) {
        const std::uint32_t other = it->second;
        if (!isRobot(body)) {
          group.pairs.push_back({With::object, place(body) - robots, place(other) - robots});
        } else if (isRobot(other)) {
          group.pairs.push_back({With::two_robots, place(body), place(other)});
        } else {
          group.pairs.push_back({With::robot, place(other) - robots, place(body)});
        }
      }
    }
    return group;
  }

  /// Stationary solids and robots at rest, which connect nothing.
  void addObstacles(std::uint32_t body, std::uint32_t object_in_group, std::vector<BodyId>& near,
                    PushingGroup& group) const {
    const TPoint2D center = centerOf(body);
    // Robots count as discs, which may be larger than their bodies.
    const double far_m = coverOf(body) + reach_m + of.radius_max_m_;
    const auto add_outline = [&](const Outline& outline) {
      group.pairs.push_back({With::stationary, object_in_group, static_cast<std::uint32_t>(group.stationary.size())});
      group.stationary.push_back(outline);
    };
    near.clear();
    scene.findBodies({center.x - far_m, center.x + far_m, center.y - far_m, center.y + far_m}, near);
    for (const auto found : near) {
      const Solid solid = scene.solid(found);
      if (!solid.heights.overlaps(heightsOf(body))) continue;
      if (static_cast<std::size_t>(found) < scene.stationaryCount()) {
        if (!isDriven(body)) add_outline(solid.outline);
        continue;
      }
      const auto moving = static_cast<std::uint32_t>(scene.movingIndex(found));
      if (isRobot(moving) && !moves(moving)) add_outline(Circle{centerOf(moving), coverOf(moving)});
    }
    const Bounds2D& surface = of.surface_;
    if (isDriven(body)) return;
    if (center.x - far_m < surface.x_min || center.x + far_m > surface.x_max || center.y - far_m < surface.y_min ||
        center.y + far_m > surface.y_max) {
      for (const auto& edge : of.edges_) add_outline(edge);
    }
  }
};

ObjectMover::ObjectMover(std::vector<MovableBody> objects, std::vector<Belt> belts, std::vector<PushingDisc> robots,
                         const Bounds2D& surface)
    : bodies_(std::move(objects)),
      belts_(std::move(belts)),
      robots_(std::move(robots)),
      edges_(edgesOf(surface)),
      surface_(surface) {
  for (const auto& body : bodies_) {
    cover_max_m_ = std::max(cover_max_m_, body.covering_radius_m);
    has_driven_ |= body.isDriven();
  }
  for (const auto& belt : belts_) {
    belt_speed_max_mps_ = std::max(belt_speed_max_mps_, std::sqrt(dot(belt.velocity_mps, belt.velocity_mps)));
  }
  for (const auto& robot : robots_) radius_max_m_ = std::max(radius_max_m_, robot.radius_m);
}

std::vector<Outline> ObjectMover::edgesOf(const Bounds2D& surface) {
  const TPoint2D middle((surface.x_min + surface.x_max) / 2, (surface.y_min + surface.y_max) / 2);
  const double half_x = (surface.x_max - surface.x_min) / 2;
  const double half_y = (surface.y_max - surface.y_min) / 2;
  const double thick = half_x + half_y;  // also covers the corners
  return {OrientedBox{{surface.x_min - thick, middle.y}, {1, 0}, thick, half_y + 2 * thick},
          OrientedBox{{surface.x_max + thick, middle.y}, {1, 0}, thick, half_y + 2 * thick},
          OrientedBox{{middle.x, surface.y_min - thick}, {1, 0}, half_x, thick},
          OrientedBox{{middle.x, surface.y_max + thick}, {1, 0}, half_x, thick}};
}

bool ObjectMover::move(const Scene& scene, const ParallelExecutor& workers, double period_s, std::uint64_t seed,
                       std::span<Path> paths, std::span<ObjectMotion> objects) {
  if (bodies_.empty()) return false;
  Search search(*this, scene, period_s, seed, paths, objects);
  search.begin();
  bool has_waited = false;
  for (std::size_t k = 0; k < search.plans.size(); ++k) {
    if (!bodies_[k].walker || search.plans[k].way_m > 0) continue;
    objects[k].walk = search.plans[k].walk;
    has_waited = true;
  }
  if (search.members.empty()) return has_waited;
  search.grow();
  const auto groups = search.groups();
  workers.forEach(groups.size(), 1, [&](std::size_t g) {
    PushingGroup group = search.groupOf(groups[g], paths, objects);
    if (!group.objects.empty()) Pushing::move(group, period_s);
  });
  return true;
}

}  // namespace robosim
