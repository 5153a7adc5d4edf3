#include "dynamics/pushing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/portable_math.h"
#include "dynamics/group_moment.h"
#include "dynamics/impulses.h"
#include "dynamics/islands.h"
#include "dynamics/sets.h"
#include "dynamics/shifts.h"
#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using With = PushingGroup::Pair::With;

/// Two gaps that differ by less are equal [m].
constexpr double kRounding_m = 1e-12;

/// The bodies of a group in a step.
class PushingStep {
 public:
  PushingStep(PushingGroup& group, double period_s)
      : group_(group), period_s_(period_s), pushing_(group.pairs.size()), pushed_(group.objects.size()) {
    for (const auto& robot : group.robots) stops_.push_back(robot.path->end_fraction);
    stops_of_driven_.resize(group.objects.size(), 1);
    for (const auto& object : group.objects) {
      from_.objects.push_back(*object.motion);
      from_.outlines.push_back(object.body->outlineAt(object.motion->world_from_object));
    }
    from_.robots.resize(stops_.size());
    to_ = from_;
    start_ = from_.objects;
  }

  void run() {
    const int parts = partCount();
    for (int i = 0; i < parts; ++i) {
      const double begin = i / static_cast<double>(parts);
      const double end = (i + 1) / static_cast<double>(parts);
      placeRobots(begin, end);
      for (std::size_t k = 0; k < from_.objects.size(); ++k) setDrivenSpeed(k, begin, end);
      part_start_ = from_.objects;
      part_reach_m_ = islandReach(group_, (end - begin) * period_s_);
      for (const Island& island : islandsOf(group_, from_, to_.robots, (end - begin) * period_s_)) {
        advance(island, begin, end, 0);
      }
    }
    for (std::size_t k = 0; k < from_.objects.size(); ++k) {
      ObjectMotion& motion = *group_.objects[k].motion;
      const ObjectMotion before = std::exchange(motion, from_.objects[k]);
      if (!isDriven(k)) continue;
      const bool was_stopped = stops_of_driven_[k] < 1;
      motion = {
          {}, motion.world_from_object, before.open_to, shareAt(k, 1), was_stopped ? before.walk : planOf(k).walk};
      if (was_stopped && group_.objects[k].body->walker) ++motion.walk.waited_steps;
    }
    for (std::size_t r = 0; r < stops_.size(); ++r) group_.robots[r].path->end_fraction = stops_[r];
  }

 private:
  enum class Result { valid, robots_blocked, overlap };

  /// In a part no object moves by more than half of the narrowest, so that nothing passes through anything.
  int partCount() const {
    double width_m = std::numeric_limits<double>::infinity();
    for (const auto& object : group_.objects) width_m = std::min(width_m, object.body->width_min_m);
    const double per_time = std::ceil(period_s_ / Pushing::kPart_s - 1e-9);
    const double per_way = std::ceil(2 * period_s_ * group_.speed_max_mps / width_m);
    return static_cast<int>(std::clamp(std::max(per_time, per_way), 1.0, 1000.0));
  }

  void placeRobots(double begin, double end) {
    for (std::size_t r = 0; r < stops_.size(); ++r) placeRobot(r, begin, end);
  }
  void placeRobot(std::size_t r, double begin, double end) {
    Path path = *group_.robots[r].path;
    path.end_fraction = stops_[r];
    from_.robots[r] = path.centerAt(begin);
    to_.robots[r] = path.centerAt(end);
  }

  bool isDriven(std::size_t i) const { return group_.objects[i].plan && group_.objects[i].body->isDriven(); }
  const DrivenPlan& planOf(std::size_t i) const { return *group_.objects[i].plan; }
  /// Share to which a door is open at a fraction of the step.
  double shareAt(std::size_t i, double fraction) const {
    const double from = start_[i].door_share;
    return from + (planOf(i).door_share - from) * std::min(fraction, stops_of_driven_[i]);
  }
  /// Where a driven body is at a fraction of the step.
  mrpt::math::TPose2D placeAt(std::size_t i, double fraction) const {
    const MovableBody& body = *group_.objects[i].body;
    if (body.door) return body.doorAt(shareAt(i, fraction));
    const auto& from = start_[i].world_from_object;
    const auto& to = planOf(i).world_from_object;
    const double share = std::min(fraction, stops_of_driven_[i]);
    return {from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share, from.phi};
  }
  void setDrivenSpeed(std::size_t i, double begin, double end) {
    if (!isDriven(i)) return;
    const auto from = placeAt(i, begin);
    const auto to = placeAt(i, end);
    const double per_s = 1 / ((end - begin) * period_s_);
    ObjectMotion& motion = from_.objects[i];
    motion.vx_mps = (to.x - from.x) * per_s;
    motion.vy_mps = (to.y - from.y) * per_s;
    motion.turn_radps = std::remainder(to.phi - from.phi, 2 * M_PI) * per_s;
  }

  /// @param begin, end of a part, as fractions of the step
  void advance(const Island& island, double begin, double end, int halvings) {
    Result result = tryPart(island, begin, end);
    while (result == Result::robots_blocked) result = tryPart(island, begin, end);
    if (result == Result::overlap && halvings < Pushing::kHalvings) {
      // What is jammed already is so in the shortest part.
      const double soon = begin + (end - begin) / (1 << Pushing::kHalvings);
      if (halvings == 0 && tryPart(island, begin, soon) == Result::overlap) {
        holdJammed(island, begin);
        keep(island);
        advance(island, soon, end, 1);
        return;
      }
      const double middle = (begin + end) / 2;
      advance(island, begin, middle, halvings + 1);
      advance(island, middle, end, halvings + 1);
      return;
    }
    if (result == Result::overlap) holdJammed(island, begin);
    keep(island);
  }

  /// The end of a part is the start of the next.
  void keep(const Island& island) {
    for (const auto i : island.objects) {
      from_.objects[i] = to_.objects[i];
      from_.outlines[i] = to_.outlines[i];
    }
  }

  /// Computes to_.
  Result tryPart(const Island& island, double begin, double end) {
    const double duration_s = (end - begin) * period_s_;
    for (const auto r : island.robots) placeRobot(r, begin, end);
    for (const auto p : island.pairs) pushing_[p] = 0;
    for (const auto i : island.objects) {
      setDrivenSpeed(i, begin, end);
      to_.objects[i] = from_.objects[i];
      to_.outlines[i] = from_.outlines[i];
      pushed_[i] = 0;
      decelerate(i, duration_s);
    }
    Impulses(group_, island, from_, to_.robots, duration_s).exchange(to_.objects, pushing_, pushed_);
    for (const auto i : island.objects) {
      if (isDriven(i)) {
        to_.objects[i].world_from_object = placeAt(i, end);
        outline(group_, i, to_);
        continue;
      }
      limitSpeed(to_.objects[i]);
      moveOn(i, duration_s);
    }
    shiftApart(group_, island, to_, pushing_);
    if (firstOverlap(island)) return Result::overlap;
    return blockOverloaded(island, begin, duration_s) ? Result::robots_blocked : Result::valid;
  }

  bool isAtRest(std::size_t r) const { return from_.robots[r] == to_.robots[r]; }

  void decelerate(std::size_t i, double duration_s) {
    ObjectMotion& motion = to_.objects[i];
    if (isDriven(i)) return;
    const MovableBody& body = *group_.objects[i].body;
    const TPoint2D floor = floorVelocityUnder(group_, motion);
    const ObjectSpeed over_floor = relativeTo(floor, motion);
    if (over_floor.isAtRest()) return;
    const double left = std::max(0.0, 1 - body.deceleration() * duration_s / speedOf(body, over_floor));
    motion.vx_mps = over_floor.vx_mps * left;
    motion.vy_mps = over_floor.vy_mps * left;
    motion.turn_radps *= left;
    if (!isStill(floor)) {
      motion.vx_mps += floor.x;
      motion.vy_mps += floor.y;
    }
  }
  static ObjectSpeed relativeTo(const TPoint2D& floor, const ObjectSpeed& speed) {
    return {speed.vx_mps - floor.x, speed.vy_mps - floor.y, speed.turn_radps};
  }
  static bool isStill(const TPoint2D& floor) { return floor.x == 0 && floor.y == 0; }

  void limitSpeed(ObjectMotion& motion) const {
    const double speed = portable::hypot(motion.vx_mps, motion.vy_mps);
    if (speed <= group_.speed_max_mps) return;
    motion.vx_mps *= group_.speed_max_mps / speed;
    motion.vy_mps *= group_.speed_max_mps / speed;
  }

  void moveOn(std::size_t i, double duration_s) {
    ObjectMotion& motion = to_.objects[i];
    const ObjectMotion& before = from_.objects[i];
    if (motion.isAtRest() && before.isAtRest()) return;
    // An object that nothing has pushed decelerates evenly, and may stop on the way.
    ObjectSpeed mean = motion;
    if (!pushed_[i]) {
      const MovableBody& body = *group_.objects[i].body;
      if (motion.isAtRest() && isStill(floorVelocityUnder(group_, before))) {
        duration_s = speedOf(body, before) / body.deceleration();
      }
      mean = {(motion.vx_mps + before.vx_mps) / 2, (motion.vy_mps + before.vy_mps) / 2,
              (motion.turn_radps + before.turn_radps) / 2};
    }
    auto& pose = motion.world_from_object;
    pose.x += mean.vx_mps * duration_s;
    pose.y += mean.vy_mps * duration_s;
    pose.phi += mean.turn_radps * duration_s;
    outline(group_, static_cast<std::uint32_t>(i), to_);
  }

  /// The first pair that has come too near; null if there is none. An object that has moved too far counts as too near
  /// to its first neighbour.
  const PushingGroup::Pair* firstOverlap(const Island& island) const {
    for (const auto p : island.pairs) {
      const PushingGroup::Pair& pair = group_.pairs[p];
      if (isTooNear(pair)) return &pair;
    }
    return nullptr;
  }

  bool isTooNear(const PushingGroup::Pair& pair) const {
    if (pair.with != With::two_robots && isTooFar(pair.first)) return true;
    if (pair.with == With::object && isTooFar(pair.second)) return true;
    if (!mayTouch(group_, to_, pair, kGapMin_m)) return false;
    const double gap_m = contactOf(group_, to_, pair).gap();
    return gap_m < kGapMin_m && gap_m < contactOf(group_, from_, pair).gap() - kRounding_m;
  }

  /// Farther than the pairs of the group and of its islands allow for.
  bool isTooFar(std::uint32_t i) const {
    const auto is_beyond = [&](const ObjectMotion& then, double reach_m) {
      const auto& now = to_.objects[i].world_from_object;
      return !isWithin({now.x, now.y}, {then.world_from_object.x, then.world_from_object.y}, reach_m);
    };
    return is_beyond(start_[i], group_.reach_m) || is_beyond(part_start_[i], part_reach_m_);
  }

  std::size_t nodeOf(std::size_t robot) const { return to_.objects.size() + robot; }

  /// Bodies that push each other in this part. Stationary solids, and robots that do not drive towards an object,
  /// connect nothing.
  Sets pushedTogether(const Island& island) const {
    Sets sets(to_.objects.size() + stops_.size());
    for (const auto r : island.robots) {
      if (const auto partner = group_.robots[r].partner) sets.join(nodeOf(r), nodeOf(*partner));
    }
    for (const auto p : island.pairs) {
      const auto& pair = group_.pairs[p];
      if (!pushing_[p]) continue;
      if (pair.with == With::object) sets.join(pair.first, pair.second);
      if (pair.with == With::robot && !isAtRest(pair.second) && drivesTowards(pair)) {
        sets.join(pair.first, nodeOf(pair.second));
      }
    }
    return sets;
  }

  /// 4 of the description. @return whether a robot is blocked that was not before
  bool blockOverloaded(const Island& island, double at, double duration_s) {
    const auto pushes = [&](std::uint32_t p) { return pushing_[p] != 0 && group_.pairs[p].with == With::robot; };
    if (std::none_of(island.pairs.begin(), island.pairs.end(), pushes)) return false;
    Sets sets = pushedTogether(island);
    std::vector<double> needed_j(to_.objects.size() + stops_.size()), available_j(needed_j.size());
    for (const auto i : island.objects) needed_j[sets.of(i)] += neededWork(i, duration_s);
    for (const auto r : island.robots) {
      if (group_.robots[r].partner > r) continue;  // the second disc of a robot drives as far
      const TPoint2D way = to_.robots[r] - from_.robots[r];
      available_j[sets.of(nodeOf(r))] += group_.robots[r].disc->push_max_n * std::sqrt(dot(way, way));
    }
    for (const auto i : island.objects) {
      if (isDriven(i) && !to_.objects[i].isAtRest()) available_j[sets.of(i)] = std::numeric_limits<double>::infinity();
    }
    constexpr double kRoundingShare = 1e-6;
    return stopRobots(island, at, [&](std::size_t r) {
      const std::size_t set = sets.of(nodeOf(r));
      return needed_j[set] > available_j[set] * (1 + kRoundingShare);
    });
  }

  /// Work against friction on the floor that an object has not paid with its own energy.
  double neededWork(std::size_t i, double duration_s) const {
    if (isDriven(i)) return 0;
    const MovableBody& body = *group_.objects[i].body;
    const auto& before = from_.objects[i].world_from_object;
    const auto& after = to_.objects[i].world_from_object;
    const TPoint2D floor = floorVelocityUnder(group_, from_.objects[i]);
    const double x_m = after.x - before.x - floor.x * duration_s;
    const double y_m = after.y - before.y - floor.y * duration_s;
    const double friction_j =
        body.friction_n * portable::hypot(portable::hypot(x_m, y_m), (after.phi - before.phi) * body.turn_radius_m);
    const auto energy_of = [&](const ObjectMotion& motion) {
      const double speed = speedOf(body, relativeTo(floor, motion));
      return body.mass_kg * speed * speed / 2;
    };
    return std::max(0.0, friction_j - std::max(0.0, energy_of(from_.objects[i]) - energy_of(to_.objects[i])));
  }

  void stop(std::size_t r, double at) {
    stops_[r] = at;
    if (const auto partner = group_.robots[r].partner) stops_[*partner] = at;
  }
  /// For the rest of a part that is computed already.
  void holdBack(std::size_t r) {
    to_.robots[r] = from_.robots[r];
    if (const auto partner = group_.robots[r].partner) to_.robots[*partner] = from_.robots[*partner];
  }

  template <typename Blocked>
  bool stopRobots(const Island& island, double at, const Blocked& is_blocked) {
    bool has_stopped = false;
    for (const auto r : island.robots) {
      if (isAtRest(r) || !is_blocked(r)) continue;
      stop(r, at);
      has_stopped = true;
    }
    return has_stopped;
  }

  /// The end of 5 of the description: what pushes each other where bodies overlap stays where it is.
  void holdJammed(const Island& island, double at) {
    while (const PushingGroup::Pair* const pair = firstOverlap(island)) {
      if (pair->with == With::robot && isDriven(pair->first) && !isAtRest(pair->second)) {
        // A robot that drives against a driven body does not hold it, and one that drives ahead of it is not stopped.
        if (!drivesTowards(*pair) && holdDriven(pair->first, at)) continue;
        stop(pair->second, at);
        holdBack(pair->second);
        continue;
      }
      Sets sets = pushedTogether(island);
      const std::size_t first = sets.of(pair->with == With::two_robots ? nodeOf(pair->first) : pair->first);
      std::size_t second = first;
      if (pair->with == With::object) second = sets.of(pair->second);
      if (pair->with == With::robot || pair->with == With::two_robots) second = sets.of(nodeOf(pair->second));
      const auto is_held = [&](std::size_t node) { return sets.of(node) == first || sets.of(node) == second; };
      for (const auto i : island.objects) {
        if (is_held(i)) hold(i, at);
      }
      stopRobots(island, at, [&](std::size_t r) { return is_held(nodeOf(r)); });
      for (const auto r : island.robots) {
        if (is_held(nodeOf(r))) holdBack(r);
      }
    }
  }

  void hold(std::size_t i, double at) {
    to_.objects[i] = {{}, from_.objects[i].world_from_object};
    to_.outlines[i] = from_.outlines[i];
    stops_of_driven_[i] = std::min(stops_of_driven_[i], at);
  }
  /// @return whether it moved
  bool holdDriven(std::size_t i, double at) {
    if (to_.objects[i].world_from_object == from_.objects[i].world_from_object) return false;
    hold(i, at);
    return true;
  }

  /// Whether the robot of a pair approaches the object by its own motion.
  bool drivesTowards(const PushingGroup::Pair& pair) const {
    const TPoint2D way = to_.robots[pair.second] - from_.robots[pair.second];
    return dot(way, contactOf(group_, from_, pair).normal) < 0;
  }

  PushingGroup& group_;
  double period_s_;
  std::vector<double> stops_;             ///< fraction of its path at which each robot ends
  std::vector<double> stops_of_driven_;   ///< by object: fraction of the step at which a driven body is blocked
  std::vector<ObjectMotion> start_;       ///< of the step
  std::vector<ObjectMotion> part_start_;  ///< of the part
  double part_reach_m_ = 0;
  GroupMoment from_, to_;              ///< at both ends of the part
  std::vector<std::uint8_t> pushing_;  ///< by pair, in this part
  std::vector<std::uint8_t> pushed_;   ///< by object: has got an impulse in this part
};

}  // namespace

void Pushing::move(PushingGroup& group, double period_s) { PushingStep(group, period_s).run(); }

}  // namespace robosim
