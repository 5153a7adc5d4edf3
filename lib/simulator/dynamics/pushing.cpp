#include "dynamics/pushing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.h"
#include "dynamics/group_moment.h"
#include "dynamics/impulses.h"
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
    for (const auto& object : group.objects) from_.objects.push_back(*object.motion);
    from_.robots.resize(stops_.size());
    start_ = from_.objects;
  }

  void run() {
    const int parts = partCount();
    for (int i = 0; i < parts; ++i) advance(i / double(parts), (i + 1) / double(parts), 0);
    for (std::size_t k = 0; k < from_.objects.size(); ++k) *group_.objects[k].motion = from_.objects[k];
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

  /// @param begin, end of a part, as fractions of the step
  void advance(double begin, double end, int halvings) {
    Result result = tryPart(begin, end);
    while (result == Result::robots_blocked) result = tryPart(begin, end);
    if (result == Result::overlap && halvings < Pushing::kHalvings) {
      const double middle = (begin + end) / 2;
      advance(begin, middle, halvings + 1);
      advance(middle, end, halvings + 1);
      return;
    }
    if (result == Result::overlap) holdJammed(begin);
    std::swap(from_, to_);
  }

  /// Computes to_.
  Result tryPart(double begin, double end) {
    const double duration_s = (end - begin) * period_s_;
    to_ = from_;
    for (std::size_t r = 0; r < stops_.size(); ++r) {
      from_.robots[r] = robotAt(r, begin);
      to_.robots[r] = robotAt(r, end);
    }
    std::fill(pushing_.begin(), pushing_.end(), 0);
    std::fill(pushed_.begin(), pushed_.end(), 0);
    for (std::size_t i = 0; i < to_.objects.size(); ++i) decelerate(i, duration_s);
    Impulses(group_, from_, to_.robots, duration_s).exchange(to_.objects, pushing_, pushed_);
    for (std::size_t i = 0; i < to_.objects.size(); ++i) {
      limitSpeed(to_.objects[i]);
      moveOn(i, duration_s);
    }
    shiftApart(group_, to_, pushing_);
    if (firstOverlap() != group_.pairs.size()) return Result::overlap;
    return blockOverloaded(begin) ? Result::robots_blocked : Result::valid;
  }

  TPoint2D robotAt(std::size_t r, double fraction) const {
    Path path = *group_.robots[r].path;
    path.end_fraction = stops_[r];
    return path.centerAt(fraction);
  }
  bool isAtRest(std::size_t r) const { return from_.robots[r] == to_.robots[r]; }

  void decelerate(std::size_t i, double duration_s) {
    ObjectMotion& motion = to_.objects[i];
    if (motion.isAtRest()) return;
    const MovableBody& body = *group_.objects[i].body;
    const double left = std::max(0.0, 1 - body.deceleration() * duration_s / speedOf(body, motion));
    motion.vx_mps *= left;
    motion.vy_mps *= left;
    motion.turn_radps *= left;
  }

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
      if (motion.isAtRest()) duration_s = speedOf(body, before) / body.deceleration();
      mean = {(motion.vx_mps + before.vx_mps) / 2, (motion.vy_mps + before.vy_mps) / 2,
              (motion.turn_radps + before.turn_radps) / 2};
    }
    auto& pose = motion.world_from_object;
    pose.x += mean.vx_mps * duration_s;
    pose.y += mean.vy_mps * duration_s;
    pose.phi += mean.turn_radps * duration_s;
  }

  /// The first pair that has come too near; the number of pairs if there is none. An object that has moved too far
  /// counts as too near to its first neighbour.
  std::size_t firstOverlap() const {
    const auto is_too_near = [&](const PushingGroup::Pair& pair) {
      if (pair.with != With::two_robots && isTooFar(pair.first)) return true;
      if (pair.with == With::object && isTooFar(pair.second)) return true;
      if (!mayTouch(group_, to_, pair, kGapMin_m)) return false;
      const double gap_m = contactOf(group_, to_, pair).gap();
      return gap_m < kGapMin_m && gap_m < contactOf(group_, from_, pair).gap() - kRounding_m;
    };
    const auto found = std::find_if(group_.pairs.begin(), group_.pairs.end(), is_too_near);
    return static_cast<std::size_t>(found - group_.pairs.begin());
  }

  bool isTooFar(std::uint32_t i) const {
    const auto& now = to_.objects[i].world_from_object;
    const auto& then = start_[i].world_from_object;
    const TPoint2D way(now.x - then.x, now.y - then.y);
    return !(dot(way, way) <= group_.reach_m * group_.reach_m);
  }

  std::size_t nodeOf(std::size_t robot) const { return to_.objects.size() + robot; }

  /// Bodies that push each other in this part. Stationary solids and robots at rest connect nothing.
  Sets pushedTogether() const {
    Sets sets(to_.objects.size() + stops_.size());
    for (std::size_t p = 0; p < group_.pairs.size(); ++p) {
      const auto& pair = group_.pairs[p];
      if (!pushing_[p]) continue;
      if (pair.with == With::object) sets.join(pair.first, pair.second);
      if (pair.with == With::robot && !isAtRest(pair.second)) sets.join(pair.first, nodeOf(pair.second));
    }
    return sets;
  }

  /// 4 of the description. @return whether a robot is blocked that was not before
  bool blockOverloaded(double at) {
    if (std::find(pushing_.begin(), pushing_.end(), 1) == pushing_.end()) return false;
    Sets sets = pushedTogether();
    std::vector<double> needed_j(to_.objects.size() + stops_.size()), available_j(needed_j.size());
    for (std::size_t i = 0; i < to_.objects.size(); ++i) needed_j[sets.of(i)] += neededWork(i);
    for (std::size_t r = 0; r < stops_.size(); ++r) {
      const TPoint2D way = to_.robots[r] - from_.robots[r];
      available_j[sets.of(nodeOf(r))] += group_.robots[r].disc->push_max_n * std::sqrt(dot(way, way));
    }
    constexpr double kRoundingShare = 1e-6;
    return stopRobots(at, [&](std::size_t r) {
      const std::size_t set = sets.of(nodeOf(r));
      return needed_j[set] > available_j[set] * (1 + kRoundingShare);
    });
  }

  /// Work against friction that an object has not paid with its own energy.
  double neededWork(std::size_t i) const {
    const MovableBody& body = *group_.objects[i].body;
    const auto& before = from_.objects[i].world_from_object;
    const auto& after = to_.objects[i].world_from_object;
    const double friction_j = body.friction_n * portable::hypot(portable::hypot(after.x - before.x, after.y - before.y),
                                                                (after.phi - before.phi) * body.turn_radius_m);
    const auto energy_of = [&](const ObjectMotion& motion) {
      const double speed = speedOf(body, motion);
      return body.mass_kg * speed * speed / 2;
    };
    return std::max(0.0, friction_j - std::max(0.0, energy_of(from_.objects[i]) - energy_of(to_.objects[i])));
  }

  template <typename Blocked>
  bool stopRobots(double at, const Blocked& is_blocked) {
    bool has_stopped = false;
    for (std::size_t r = 0; r < stops_.size(); ++r) {
      if (isAtRest(r) || !is_blocked(r)) continue;
      stops_[r] = at;
      has_stopped = true;
    }
    return has_stopped;
  }

  /// The end of 5 of the description: what pushes each other where bodies overlap stays where it is.
  void holdJammed(double at) {
    for (std::size_t p = firstOverlap(); p < group_.pairs.size(); p = firstOverlap()) {
      const auto& pair = group_.pairs[p];
      Sets sets = pushedTogether();
      const std::size_t first = sets.of(pair.with == With::two_robots ? nodeOf(pair.first) : std::size_t{pair.first});
      std::size_t second = first;
      if (pair.with == With::object) second = sets.of(pair.second);
      if (pair.with == With::robot || pair.with == With::two_robots) second = sets.of(nodeOf(pair.second));
      const auto is_held = [&](std::size_t node) { return sets.of(node) == first || sets.of(node) == second; };
      for (std::size_t i = 0; i < to_.objects.size(); ++i) {
        if (is_held(i)) to_.objects[i] = {{}, from_.objects[i].world_from_object};
      }
      stopRobots(at, [&](std::size_t r) { return is_held(nodeOf(r)); });
      for (std::size_t r = 0; r < stops_.size(); ++r) {
        if (is_held(nodeOf(r))) to_.robots[r] = from_.robots[r];
      }
    }
  }

  PushingGroup& group_;
  double period_s_;
  std::vector<double> stops_;          ///< fraction of its path at which each robot ends
  std::vector<ObjectMotion> start_;    ///< of the step
  GroupMoment from_, to_;              ///< at both ends of this part
  std::vector<std::uint8_t> pushing_;  ///< by pair, in this part
  std::vector<std::uint8_t> pushed_;   ///< by object: has got an impulse in this part
};

}  // namespace

void Pushing::move(PushingGroup& group, double period_s) { PushingStep(group, period_s).run(); }

}  // namespace robosim
