#include "dynamics/driven_plans.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_math.h"
#include "dynamics/contact.h"
#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// More than contacts and rounding need [m].
constexpr double kClear_m = 20 * kContactGap_m;

TPoint2D centerOf(const ObjectMotion& motion) { return {motion.world_from_object.x, motion.world_from_object.y}; }

class DrivenPlanner {
 public:
  explicit DrivenPlanner(const DrivenSurroundings& around) : around_(around), plans_(around.bodies.size()) {
    for (const auto& body : around.bodies) widest_m_ = std::max(widest_m_, body.covering_radius_m);
    for (const auto& robot : around.robots) widest_m_ = std::max(widest_m_, robot.radius_m);
    for (std::size_t k = 0; k < around.bodies.size(); ++k) {
      const MovableBody& body = around.bodies[k];
      if (!body.isDriven()) continue;
      driven_.push_back(k);
      plans_[k] = body.door ? planDoor(k) : planWalk(k);
    }
  }

  std::vector<DrivenPlan> run() {
    const std::vector<DrivenPlan> wanted = plans_;
    for (const auto k : driven_) way_max_m_ = std::max(way_max_m_, wanted[k].way_m);
    for (const auto k : driven_) {
      if (wanted[k].way_m == 0) continue;
      const bool is_free = around_.bodies[k].door ? isDoorFree(k, wanted) : isWalkFree(k, wanted);
      if (!is_free) plans_[k] = waiting(k, wanted[k]);
    }
    return std::move(plans_);
  }

 private:
  DrivenPlan planDoor(std::size_t k) const {
    const ObjectMotion& motion = around_.objects[k];
    const Door& door = *around_.bodies[k].door;
    const double to = isApproached(k) ? 1 : motion.open_to;
    const double most = door.shareRate() * around_.period_s;
    DrivenPlan plan{.door_share = std::clamp(to, motion.door_share - most, motion.door_share + most)};
    const double share = std::abs(plan.door_share - motion.door_share);
    const double length_m = std::get<Cube>(around_.bodies[k].shape).length_m;
    // The far end of one that turns, whose hinge is at the middle of its side, is at most this far from the hinge.
    const double arm_m = length_m / 2 + around_.bodies[k].covering_radius_m;
    plan.way_m = share * (door.turn_rad == 0 ? std::abs(door.slide_m) : std::abs(door.turn_rad) * arm_m);
    return plan;
  }

  bool isApproached(std::size_t door) const {
    const MovableBody& body = around_.bodies[door];
    const double within_m = body.door->opens_within_m;
    if (within_m == 0) return false;
    const auto closed = body.doorAt(0);
    const Outline outline = body.outlineAt(closed);
    const auto near = movingNear({closed.x, closed.y}, body.covering_radius_m + within_m);
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t moving) {
      const bool opens = isRobot(moving) || around_.bodies[moving - around_.paths.size()].walker;
      return opens && distance(outline, centerOfMoving(moving)) <= radiusOfMoving(moving) + within_m;
    });
  }

  DrivenPlan planWalk(std::size_t k) const {
    const ObjectMotion& motion = around_.objects[k];
    const Walker& walker = *around_.bodies[k].walker;
    DrivenPlan plan{.world_from_object = motion.world_from_object, .walk = motion.walk};
    double left_m = walker.speed_mps * around_.period_s;
    TPoint2D at = centerOf(motion);
    constexpr int kLegsMax = 10;  // in a step; places may coincide
    for (int leg = 0; leg < kLegsMax && left_m > 0; ++leg) {
      const TPoint2D target = walker.targetOf(plan.walk, around_.seed, around_.bodies[k].walker_stream);
      const TPoint2D way = target - at;
      const double way_m = portable::hypot(way.x, way.y);
      if (way_m > left_m) {
        at = at + way * (left_m / way_m);
        break;
      }
      at = target;
      left_m -= way_m;
      plan.walk = walker.nextLeg(plan.walk);
    }
    plan.world_from_object.x = at.x;
    plan.world_from_object.y = at.y;
    plan.walk.waited_steps = 0;
    plan.way_m = walker.speed_mps * around_.period_s;
    return plan;
  }

  /// @param wanted what is not possible in this step
  DrivenPlan waiting(std::size_t k, const DrivenPlan& wanted) const {
    const ObjectMotion& motion = around_.objects[k];
    DrivenPlan plan{motion.door_share, motion.world_from_object, motion.walk, 0};
    if (around_.bodies[k].door) return plan;
    const Walker& walker = *around_.bodies[k].walker;
    ++plan.walk.waited_steps;
    // A random way that leads to a wall is given up at once.
    const bool gives_up = walker.route.empty() && !isStationaryFree(k, wanted);
    if (gives_up || plan.walk.waited_steps * around_.period_s >= Walker::kPatience_s) {
      plan.walk = walker.turnedBack(motion.walk);
      plan.walk.waited_steps = 0;
    }
    return plan;
  }

  /// Robots and objects of which a part is within a distance of a point, and some others.
  std::vector<std::uint32_t> movingNear(const TPoint2D& at, double within_m) const {
    std::vector<std::uint32_t> near;
    around_.scene.findMoving(at, within_m + widest_m_, around_.scene.movingCount(), near);
    return near;
  }
  /// Doors and walkers that may come within a distance of a body's place in the step, and some others.
  std::vector<std::size_t> drivenNear(const mrpt::math::TPose2D& at, double within_m) const {
    std::vector<std::size_t> driven;
    for (const auto moving : movingNear({at.x, at.y}, within_m + way_max_m_ + kClear_m)) {
      if (isRobot(moving)) continue;
      const std::size_t object = moving - around_.paths.size();
      if (around_.bodies[object].isDriven()) driven.push_back(object);
    }
    return driven;
  }

  bool isRobot(std::uint32_t moving) const { return moving < around_.paths.size(); }
  TPoint2D centerOfMoving(std::uint32_t moving) const {
    if (!isRobot(moving)) return centerOf(around_.objects[moving - around_.paths.size()]);
    const auto& pose = around_.paths[moving].world_from_start;
    return {pose.x, pose.y};
  }
  double radiusOfMoving(std::uint32_t moving) const {
    return isRobot(moving) ? around_.robots[moving].radius_m
                           : around_.bodies[moving - around_.paths.size()].covering_radius_m;
  }

  /// Whether a door stays away from all that walkers may reach.
  bool isDoorFree(std::size_t door, const std::vector<DrivenPlan>& wanted) const {
    const MovableBody& body = around_.bodies[door];
    const Outline outline = body.outlineAt(body.doorAt(wanted[door].door_share));
    const auto near = drivenNear(body.doorAt(wanted[door].door_share), body.covering_radius_m);
    return std::none_of(near.begin(), near.end(), [&](std::size_t k) {
      const MovableBody& other = around_.bodies[k];
      return other.walker && other.heights.overlaps(body.heights) &&
             distance(outline, centerOf(around_.objects[k])) < other.covering_radius_m + wanted[k].way_m + kClear_m;
    });
  }

  bool isWalkFree(std::size_t k, const std::vector<DrivenPlan>& wanted) const {
    return isStationaryFree(k, wanted[k]) && isClearOfDriven(k, wanted) && isAheadFree(k, wanted[k]);
  }

  bool isStationaryFree(std::size_t k, const DrivenPlan& wanted) const {
    const MovableBody& body = around_.bodies[k];
    const TPoint2D to(wanted.world_from_object.x, wanted.world_from_object.y);
    const Bounds2D area = boundsOf(body.outlineAt(wanted.world_from_object));
    if (!around_.surface.covers(area)) return false;
    std::vector<BodyId> near;
    around_.scene.findBodies(area, near);
    return std::none_of(near.begin(), near.end(), [&](BodyId found) {
      if (static_cast<std::size_t>(found) >= around_.scene.stationaryCount()) return false;
      const Solid solid = around_.scene.solid(found);
      return solid.heights.overlaps(body.heights) && distance(solid.outline, to) < body.covering_radius_m + kClear_m;
    });
  }

  /// Whether a walker stays away from all that doors and other walkers may reach, or walks away from it.
  bool isClearOfDriven(std::size_t k, const std::vector<DrivenPlan>& wanted) const {
    const MovableBody& body = around_.bodies[k];
    const TPoint2D from = centerOf(around_.objects[k]);
    const TPoint2D to(wanted[k].world_from_object.x, wanted[k].world_from_object.y);
    const auto near = drivenNear(wanted[k].world_from_object, body.covering_radius_m);
    return std::none_of(near.begin(), near.end(), [&](std::size_t other) {
      if (other == k || !around_.bodies[other].heights.overlaps(body.heights)) return false;
      const Outline outline = around_.bodies[other].outlineAt(around_.objects[other].world_from_object);
      const double near_m = body.covering_radius_m + wanted[other].way_m + kClear_m;
      if (distance(outline, to) >= near_m) return false;
      const TPoint2D away = from - nearestPoint(outline, from);
      // Within 60 degrees of the direction away from it.
      return dot(to - from, away) < std::sqrt(dot(to - from, to - from) * dot(away, away)) / 2;
    });
  }

  /// Whether nothing that moves by itself is ahead of a walker, within the distance at which it stops.
  bool isAheadFree(std::size_t k, const DrivenPlan& wanted) const {
    const MovableBody& body = around_.bodies[k];
    const TPoint2D from = centerOf(around_.objects[k]);
    const TPoint2D to(wanted.world_from_object.x, wanted.world_from_object.y);
    const TPoint2D way = to - from;
    const double way_m = portable::hypot(way.x, way.y);
    if (way_m == 0) return true;
    const double half_m = (way_m + body.covering_radius_m + body.walker->stops_within_m) / 2;
    const OrientedBox ahead{from + way * (half_m / way_m), way * (1 / way_m), half_m, body.covering_radius_m};
    const auto near = movingNear(ahead.center, half_m + body.covering_radius_m);
    return std::none_of(near.begin(), near.end(), [&](std::uint32_t moving) {
      if (isRobot(moving)) {
        return around_.robots[moving].heights.overlaps(body.heights) &&
               distance(ahead, centerOfMoving(moving)) < around_.robots[moving].radius_m;
      }
      const std::size_t other = moving - around_.paths.size();
      const MovableBody& in_way = around_.bodies[other];
      return other != k && (in_way.isDriven() || heldIndexOf(around_.held, other)) &&
             in_way.heights.overlaps(body.heights) &&
             distance(ahead, in_way.outlineAt(around_.objects[other].world_from_object)) == 0;
    });
  }

  const DrivenSurroundings& around_;
  std::vector<std::size_t> driven_;  ///< objects
  std::vector<DrivenPlan> plans_;
  double widest_m_ = 0;   ///< of all moving bodies
  double way_max_m_ = 0;  ///< of all doors and walkers
};

}  // namespace

std::vector<DrivenPlan> planDriven(const DrivenSurroundings& around) { return DrivenPlanner(around).run(); }

}  // namespace robosim
