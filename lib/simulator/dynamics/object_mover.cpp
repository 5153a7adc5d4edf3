#include "dynamics/object_mover.h"

#include <algorithm>
#include <cmath>
#include <optional>
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

/// Finds what may touch in a step, and divides it into groups. The bodies are discs that drive along paths, which are
/// the robots and then the objects that they hold; then all objects.
struct ObjectMover::Search {
  const ObjectMover& of;
  const Scene& scene;
  std::span<const Path> paths;
  std::span<const ObjectMotion> objects;
  std::span<const HeldObject> held;
  std::vector<Path> held_paths;          ///< by held object
  std::vector<PushingDisc> held_discs;   ///< by held object
  std::vector<std::uint8_t> disc_moves;  ///< by disc; paths change while groups are computed
  std::vector<DrivenPlan> plans;         ///< by object
  double speed_max_mps = 0;              ///< of all bodies at the start of the step
  double reach_m = 0;                    ///< no object moves farther
  double path_max_m = 0;
  double radius_max_m = 0;  ///< of the discs
  Sets sets;
  std::vector<std::uint8_t> is_member;  ///< by body: an object that may move, or a robot that such a one may block
  std::vector<std::uint32_t> members;   ///< in the order found
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< lower body first; a member, and what it may touch

  Search(const ObjectMover& mover, const Scene& the_scene, double period_s, std::uint64_t seed,
         std::span<const HeldObject> the_held, std::span<const Path> the_paths,
         std::span<const ObjectMotion> the_objects)
      : of(mover),
        scene(the_scene),
        paths(the_paths),
        objects(the_objects),
        held(the_held),
        radius_max_m(mover.radius_max_m_),
        sets(the_paths.size() + the_held.size() + the_objects.size()),
        is_member(the_paths.size() + the_held.size() + the_objects.size()) {
    for (const auto& path : paths) addPath(path, period_s);
    for (const auto& object : held) {
      held_paths.push_back(object.pathOf(paths[object.robot]));
      held_discs.push_back({object.radius_m, object.heights, of.robots_[object.robot].push_max_n});
      radius_max_m = std::max(radius_max_m, object.radius_m);
      addPath(held_paths.back(), period_s);
    }
    // The two discs of a robot move together.
    for (std::uint32_t h = 0; h < held.size(); ++h) {
      disc_moves[held[h].robot] = disc_moves[robotCount() + h] =
          disc_moves[held[h].robot] | disc_moves[robotCount() + h];
    }
    if (of.has_driven_) {
      plans = planDriven({scene, of.surface_, of.bodies_, objects, of.robots_, held, paths, period_s, seed});
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

  void addPath(const Path& path, double period_s) {
    disc_moves.push_back(path.clippedLength() != 0 ? 1 : 0);
    path_max_m = std::max(path_max_m, std::abs(path.clippedLength()));
    // A clipped robot drives as fast as another, until it stops.
    if (path.clippedLength() != 0) speed_max_mps = std::max(speed_max_mps, std::abs(path.length_m) / period_s);
  }

  std::uint32_t robotCount() const { return static_cast<std::uint32_t>(paths.size()); }
  std::uint32_t discCount() const { return static_cast<std::uint32_t>(paths.size() + held.size()); }
  bool isDisc(std::uint32_t body) const { return body < discCount(); }
  bool isDriven(std::uint32_t body) const { return !isDisc(body) && object(body).isDriven(); }
  std::uint32_t bodyOf(std::size_t object) const { return discCount() + static_cast<std::uint32_t>(object); }
  /// @param moving index in the scene, of robots and then objects
  std::uint32_t bodyOfMoving(std::uint32_t moving) const {
    if (moving < robotCount()) return moving;
    const auto h = heldIndexOf(held, moving - robotCount());
    return h ? robotCount() + *h : bodyOf(moving - robotCount());
  }
  /// The other disc of a robot that holds an object, of one of its discs; nullopt for other bodies.
  std::optional<std::uint32_t> partnerOf(std::uint32_t body) const {
    if (held.empty() || !isDisc(body)) return std::nullopt;
    if (body >= robotCount()) return held[body - robotCount()].robot;
    const HeldObject* const found = heldBy(held, body);
    return found ? std::optional(robotCount() + static_cast<std::uint32_t>(found - held.data())) : std::nullopt;
  }
  const MovableBody& object(std::uint32_t body) const { return of.bodies_[body - discCount()]; }
  const PushingDisc& disc(std::uint32_t body) const {
    return body < robotCount() ? of.robots_[body] : held_discs[body - robotCount()];
  }
  const Path& pathOf(std::uint32_t disc) const {
    return disc < robotCount() ? paths[disc] : held_paths[disc - robotCount()];
  }
  bool moves(std::uint32_t disc) const { return disc_moves[disc] != 0; }
  TPoint2D centerOf(std::uint32_t body) const {
    if (isDisc(body)) return startOf(pathOf(body));
    const auto& pose = objects[body - discCount()].world_from_object;
    return {pose.x, pose.y};
  }
  double coverOf(std::uint32_t body) const {
    return isDisc(body) ? disc(body).radius_m : object(body).covering_radius_m;
  }
  const HeightSpan& heightsOf(std::uint32_t body) const {
    return isDisc(body) ? disc(body).heights : object(body).heights;
  }
  /// The farthest that a body may move in this step.
  double reachOf(std::uint32_t body) const { return isDisc(body) ? std::abs(pathOf(body).clippedLength()) : reach_m; }

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
      if (heldIndexOf(held, k)) continue;
      const bool is_driven_on = !plans.empty() && plans[k].way_m > 0;
      if (is_driven_on || !objects[k].isAtRest() || isCarried(k)) add(bodyOf(k));
    }
    std::vector<std::uint32_t> near;
    for (std::uint32_t d = 0; d < discCount(); ++d) {
      if (!moves(d)) continue;
      const double from_disc_m = coverOf(d) + reachOf(d) + kSlack_m;
      scene.findMoving(centerOf(d), from_disc_m + of.cover_max_m_, scene.movingCount(), near);
      for (const auto moving : near) {
        const std::uint32_t body = bodyOfMoving(moving);
        if (isDisc(body) || !heightsOf(body).overlaps(heightsOf(d))) continue;
        if (isWithin(centerOf(d), centerOf(body), from_disc_m + coverOf(body))) add(body);
      }
    }
  }

  /// Adds what the members may touch, until nothing more is found.
  void grow() {
    std::vector<std::uint32_t> near;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const std::uint32_t body = members[m];
      const double own_m = coverOf(body) + reachOf(body) + kSlack_m;
      const double other_max_m = std::max(of.cover_max_m_ + reach_m, radius_max_m + path_max_m);
      if (const auto partner = partnerOf(body)) {
        add(*partner);
        sets.join(body, *partner);
      }
      scene.findMoving(centerOf(body), own_m + other_max_m, scene.movingCount(), near);
      for (const auto moving : near) {
        const std::uint32_t other = bodyOfMoving(moving);
        if (other != body && heightsOf(other).overlaps(heightsOf(body))) meet(body, other, own_m + coverOf(other));
      }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

  /// @param touch_m distance of the centres within which the member may touch the other where that is now
  void meet(std::uint32_t member, std::uint32_t other, double touch_m) {
    const bool touches_where_it_is = isWithin(centerOf(member), centerOf(other), touch_m);
    if (isDisc(other) && (!moves(other) || partnerOf(other) == member)) return;  // an obstacle (addObstacles())
    if (isDriven(member) && isDriven(other)) return;  // planDriven() has kept them apart; doors may be in walls
    if (!isWithin(centerOf(member), centerOf(other), touch_m + reachOf(other))) return;
    // An object at rest that cannot be touched is no member yet; if it becomes one, it meets this one.
    if (!isDisc(other) && !is_member[other] && !touches_where_it_is) return;
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
                       std::span<ObjectMotion> moved_objects) {
    PushingGroup group;
    group.reach_m = reach_m;
    group.speed_max_mps = speed_max_mps;
    group.belts = of.belts_;
    const auto place = [&](std::uint32_t body) {
      return static_cast<std::uint32_t>(std::lower_bound(bodies.begin(), bodies.end(), body) - bodies.begin());
    };
    for (const auto body : bodies) {
      if (isDisc(body)) {
        Path* const path = body < robotCount() ? &moved_paths[body] : &held_paths[body - robotCount()];
        const auto partner = partnerOf(body);
        group.robots.push_back({&disc(body), path, partner ? std::optional(place(*partner)) : std::nullopt});
      } else {
        const std::size_t k = body - discCount();
        group.objects.push_back({&object(body), &moved_objects[k], plans.empty() ? nullptr : &plans[k]});
      }
    }
    const auto robots = static_cast<std::uint32_t>(group.robots.size());
    std::vector<BodyId> near;
    for (std::uint32_t k = 0; k < group.objects.size(); ++k) addObstacles(bodies[robots + k], k, near, group);
    for (const auto body : bodies) {
      for (auto it = std::lower_bound(pairs.begin(), pairs.end(), std::pair{body, std::uint32_t{0}});
           it != pairs.end() && it->first == body; ++it) {
        const std::uint32_t other = it->second;
        if (!isDisc(body)) {
          group.pairs.push_back({With::object, place(body) - robots, place(other) - robots});
        } else if (isDisc(other)) {
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
    const double far_m = coverOf(body) + reach_m + radius_max_m;
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
      const std::uint32_t other = bodyOfMoving(static_cast<std::uint32_t>(scene.movingIndex(found)));
      if (isDisc(other) && !moves(other)) add_outline(Circle{centerOf(other), coverOf(other)});
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
                       std::span<const HeldObject> held, std::span<Path> paths, std::span<ObjectMotion> objects) {
  if (bodies_.empty()) return false;
  Search search(*this, scene, period_s, seed, held, paths, objects);
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
