#include "dynamics/pushing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.h"
#include "geometry/shapes/planar_vector.h"
#include "dynamics/sets.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using With = PushingGroup::Pair::With;

/// Bodies nearer than this touch: they exchange impulses [m].
constexpr double kTouch_m = 3 * kContactGap_m;
/// Remaining faults of the shifts, so that gaps stay above kGapMin_m [m].
constexpr double kShiftFault_m = kContactGap_m / 4;
constexpr double kGapMin_m = kContactGap_m / 4;
/// Two gaps that differ by less are equal [m].
constexpr double kRounding_m = 1e-12;
constexpr int kBouncesMax = 32, kImpulseSweepsMax = 500, kShiftSweepsMax = 200;
/// Below this, two bodies do not approach each other [m/s].
constexpr double kApproachMin_mps = 1e-10;

/// A contact during a part of a step, with the impulses that it has transferred.
struct ActiveContact {
  std::size_t pair;
  Contact contact;
  double impulse_ns[2] = {0, 0};
};

/// Response of a body to impulses along a normal: how fast it makes the contact points move away from each other.
struct Lever {
  double per_mass;  ///< 1 / mass; 0 for one that does not give way
  double per_turn;  ///< 1 / (mass · turn_radius²)
  double arm_m[2];  ///< torque about its centre per impulse
  double mobility(int i, int j) const { return per_mass + per_turn * arm_m[i] * arm_m[j]; }
};

class PushingStep {
 public:
  PushingStep(PushingGroup& group, double period_s)
      : group_(group),
        period_s_(period_s),
        stopped_at_(group.robots.size()),
        robot_from_(group.robots.size()),
        robot_to_(group.robots.size()),
        active_(group.pairs.size()) {
    for (std::size_t r = 0; r < stopped_at_.size(); ++r) stopped_at_[r] = group.robots[r].path->end_fraction;
    for (const auto& object : group.objects) {
      start_.push_back(object.motion->world_from_object);
      from_.push_back(*object.motion);
    }
  }

  void run() {
    const int parts = partCount();
    for (int i = 0; i < parts; ++i) advance(i / double(parts), (i + 1) / double(parts), 0);
    for (std::size_t k = 0; k < from_.size(); ++k) *group_.objects[k].motion = from_[k];
    for (std::size_t r = 0; r < stopped_at_.size(); ++r) group_.robots[r].path->end_fraction = stopped_at_[r];
  }

 private:
  enum class Result { valid, robots_blocked, overlap };

  /// In a part nothing moves by more than half of the narrowest object, so that nothing passes through anything.
  int partCount() const {
    double width_m = std::numeric_limits<double>::infinity();
    for (const auto& object : group_.objects) width_m = std::min(width_m, object.body->width_min_m);
    const double per_time = std::ceil(period_s_ / Pushing::kPart_s - 1e-9);
    const double per_way = std::ceil(2 * period_s_ * group_.speed_max_mps / width_m);
    return static_cast<int>(std::clamp(std::max(per_time, per_way), 1.0, 1000.0));
  }

  /// @param from, to fractions of the step
  void advance(double from, double to, int halvings) {
    Result result = tryPart(from, to);
    while (result == Result::robots_blocked) result = tryPart(from, to);
    if (result == Result::overlap && halvings < Pushing::kHalvings) {
      const double middle = (from + to) / 2;
      advance(from, middle, halvings + 1);
      advance(middle, to, halvings + 1);
      return;
    }
    if (result == Result::overlap) holdJammed(from);
    std::swap(from_, to_);
  }

  Result tryPart(double from, double to) {
    duration_s_ = (to - from) * period_s_;
    for (std::size_t r = 0; r < stopped_at_.size(); ++r) {
      robot_from_[r] = robotAt(r, from);
      robot_to_[r] = robotAt(r, to);
    }
    std::fill(active_.begin(), active_.end(), 0);
    to_ = from_;
    exchangeImpulses();
    moveOn();
    shiftApart();
    if (firstOverlap(0) != group_.pairs.size()) return Result::overlap;
    return blockOverloaded(from) ? Result::robots_blocked : Result::valid;
  }

  TPoint2D robotAt(std::size_t r, double fraction) const {
    Path path = *group_.robots[r].path;
    path.end_fraction = stopped_at_[r];
    return path.centerAt(fraction);
  }
  bool isStopped(std::size_t r) const { return robot_from_[r] == robot_to_[r]; }

  Outline outlineOf(const std::vector<ObjectMotion>& motions, const std::vector<TPoint2D>& robots, With with,
                    std::uint32_t i) const {
    switch (with) {
      case With::object:
        return group_.objects[i].body->outlineAt(motions[i].world_from_object);
      case With::stationary:
        return group_.stationary[i];
      default:
        return Circle{robots[i], group_.robots[i].disc->radius_m};
    }
  }

  Contact contactOfPair(const std::vector<ObjectMotion>& motions, const std::vector<TPoint2D>& robots,
                        const PushingGroup::Pair& pair) const {
    const With first = pair.with == With::two_robots ? With::robot : With::object;
    return contactOf(outlineOf(motions, robots, first, pair.first), outlineOf(motions, robots, pair.with, pair.second));
  }

  Lever leverOf(const std::vector<ObjectMotion>& motions, With with, std::uint32_t i, const Contact& contact) const {
    if (with != With::object) return {0, 0, {0, 0}};
    const MovableBody& body = *group_.objects[i].body;
    const auto& pose = motions[i].world_from_object;
    const TPoint2D center(pose.x, pose.y);
    return {
        1 / body.mass_kg,
        1 / (body.mass_kg * body.turn_radius_m * body.turn_radius_m),
        {cross(contact.points[0].at - center, contact.normal), cross(contact.points[1].at - center, contact.normal)}};
  }

  TPoint2D velocityAt(With with, std::uint32_t i, const TPoint2D& point) const {
    if (with == With::stationary) return {};
    if (with == With::robot) return (robot_to_[i] - robot_from_[i]) * (1 / duration_s_);
    const ObjectMotion& motion = to_[i];
    const TPoint2D arm(point.x - motion.world_from_object.x, point.y - motion.world_from_object.y);
    return {motion.vx_mps - motion.turn_radps * arm.y, motion.vy_mps + motion.turn_radps * arm.x};
  }

  /// Speed at which the bodies of a contact separate at a point.
  double separation(const PushingGroup::Pair& pair, const TPoint2D& normal, const TPoint2D& at) const {
    return dot(velocityAt(pair.with, pair.second, at) - velocityAt(With::object, pair.first, at), normal);
  }

  void applyImpulse(const PushingGroup::Pair& pair, const TPoint2D& normal, const TPoint2D& at, double impulse_ns) {
    const auto apply = [&](std::uint32_t i, double signed_ns) {
      const MovableBody& body = *group_.objects[i].body;
      ObjectMotion& motion = to_[i];
      const TPoint2D arm(at.x - motion.world_from_object.x, at.y - motion.world_from_object.y);
      motion.vx_mps += normal.x * signed_ns / body.mass_kg;
      motion.vy_mps += normal.y * signed_ns / body.mass_kg;
      motion.turn_radps += cross(arm, normal) * signed_ns / (body.mass_kg * body.turn_radius_m * body.turn_radius_m);
      is_pushed_[i] = 1;
    };
    apply(pair.first, -impulse_ns);
    if (pair.with == With::object) apply(pair.second, impulse_ns);
  }

  /// 1 and 2 of the description.
  void exchangeImpulses() {
    is_pushed_.assign(to_.size(), 0);
    for (std::size_t i = 0; i < to_.size(); ++i) decelerate(*group_.objects[i].body, to_[i]);
    contacts_.clear();
    for (std::size_t p = 0; p < group_.pairs.size(); ++p) {
      const auto& pair = group_.pairs[p];
      if (pair.with == With::two_robots || !mayTouch(from_, robot_from_, pair, kTouch_m)) continue;
      const Contact contact = contactOfPair(from_, robot_from_, pair);
      if (contact.gap() <= kTouch_m) contacts_.push_back({p, contact});
    }
    bounce();
    stopApproaches();
    for (const auto& active : contacts_) {
      if (active.impulse_ns[0] > 0 || active.impulse_ns[1] > 0) active_[active.pair] = 1;
    }
    for (auto& motion : to_) limitSpeed(motion);
  }

  void decelerate(const MovableBody& body, ObjectMotion& motion) const {
    if (motion.isAtRest()) return;
    const double speed = speedOf(body, motion);
    const double left = std::max(0.0, 1 - body.deceleration() * duration_s_ / speed);
    motion.vx_mps *= left;
    motion.vy_mps *= left;
    motion.turn_radps *= left;
  }

  static double speedOf(const MovableBody& body, const ObjectMotion& motion) {
    return portable::hypot(portable::hypot(motion.vx_mps, motion.vy_mps), motion.turn_radps * body.turn_radius_m);
  }

  void limitSpeed(ObjectMotion& motion) const {
    const double speed = portable::hypot(motion.vx_mps, motion.vy_mps);
    if (speed <= group_.speed_max_mps) return;
    motion.vx_mps *= group_.speed_max_mps / speed;
    motion.vy_mps *= group_.speed_max_mps / speed;
  }

  /// Lets bodies that approach fast bounce, one pair after the other. None of these collisions increases the energy of
  /// objects among themselves.
  void bounce() {
    for (int round = 0; round < kBouncesMax; ++round) {
      bool has_bounced = false;
      for (auto& active : contacts_) {
        const auto& pair = group_.pairs[active.pair];
        const double restitution = restitutionOf(pair);
        if (restitution == 0) continue;
        const TPoint2D at = middleOf(active.contact);
        const double speed = separation(pair, active.contact.normal, at);
        if (speed > -Pushing::kBounceMin_mps) continue;
        Contact of_middle = active.contact;
        of_middle.points[0].at = of_middle.points[1].at = at;
        const Lever first = leverOf(from_, With::object, pair.first, of_middle);
        const Lever second = leverOf(from_, pair.with, pair.second, of_middle);
        const double mobility = first.mobility(0, 0) + second.mobility(0, 0);
        applyImpulse(pair, active.contact.normal, at, -(1 + restitution) * speed / mobility);
        active_[active.pair] = 1;
        has_bounced = true;
      }
      if (!has_bounced) return;
    }
  }

  double restitutionOf(const PushingGroup::Pair& pair) const {
    const double of_first = group_.objects[pair.first].body->restitution;
    return pair.with == With::object ? std::max(of_first, group_.objects[pair.second].body->restitution) : of_first;
  }

  /// Middle of the points that touch.
  static TPoint2D middleOf(const Contact& contact) {
    const auto& points = contact.points;
    if (contact.count == 1 || points[1].gap_m > kTouch_m) return points[0].at;
    if (points[0].gap_m > kTouch_m) return points[1].at;
    return (points[0].at + points[1].at) * 0.5;
  }

  /// Solves for the impulses after which no touching points approach each other. Each single change decreases the
  /// energy of objects among themselves.
  void stopApproaches() {
    for (int sweep = 0; sweep < kImpulseSweepsMax; ++sweep) {
      double fastest_mps = 0;
      for (auto& active : contacts_) {
        const auto& pair = group_.pairs[active.pair];
        const Lever first = leverOf(from_, With::object, pair.first, active.contact);
        const Lever second = leverOf(from_, pair.with, pair.second, active.contact);
        for (int i = 0; i < active.contact.count; ++i) {
          if (active.contact.points[i].gap_m > kTouch_m) continue;
          const TPoint2D& at = active.contact.points[i].at;
          const double speed = separation(pair, active.contact.normal, at);
          const double mobility = first.mobility(i, i) + second.mobility(i, i);
          const double impulse = std::max(-active.impulse_ns[i], -speed / mobility);
          if (impulse == 0) continue;
          active.impulse_ns[i] += impulse;
          applyImpulse(pair, active.contact.normal, at, impulse);
          fastest_mps = std::max(fastest_mps, std::abs(impulse) * mobility);
        }
      }
      if (fastest_mps <= kApproachMin_mps) return;
    }
  }

  void moveOn() {
    for (std::size_t i = 0; i < to_.size(); ++i) {
      ObjectMotion& motion = to_[i];
      if (motion.isAtRest() && from_[i].isAtRest()) continue;
      // An object that nothing touches decelerates evenly, and may stop on the way.
      double time_s = duration_s_;
      ObjectMotion mean = motion;
      if (!is_pushed_[i]) {
        const MovableBody& body = *group_.objects[i].body;
        const double speed = speedOf(body, from_[i]);
        if (motion.isAtRest()) time_s = speed / body.deceleration();
        mean.vx_mps = (motion.vx_mps + from_[i].vx_mps) / 2;
        mean.vy_mps = (motion.vy_mps + from_[i].vy_mps) / 2;
        mean.turn_radps = (motion.turn_radps + from_[i].turn_radps) / 2;
      }
      auto& pose = motion.world_from_object;
      pose.x += mean.vx_mps * time_s;
      pose.y += mean.vy_mps * time_s;
      pose.phi += mean.turn_radps * time_s;
    }
  }

  /// 3 of the description: nonlinear Gauss-Seidel, each contact with both of its points at once.
  void shiftApart() {
    for (int sweep = 0; sweep < kShiftSweepsMax; ++sweep) {
      bool is_apart = true;
      for (std::size_t p = 0; p < group_.pairs.size(); ++p) {
        const auto& pair = group_.pairs[p];
        if (pair.with == With::two_robots || !mayTouch(to_, robot_to_, pair, kContactGap_m)) continue;
        const Contact contact = contactOfPair(to_, robot_to_, pair);
        if (contact.gap() >= kContactGap_m - kShiftFault_m) continue;
        shift(pair, contact);
        active_[p] = 1;
        is_apart = false;
      }
      if (is_apart) return;
    }
  }

  void shift(const PushingGroup::Pair& pair, const Contact& contact) {
    const Lever first = leverOf(to_, With::object, pair.first, contact);
    const Lever second = leverOf(to_, pair.with, pair.second, contact);
    const double need[2] = {kContactGap_m - contact.points[0].gap_m,
                            contact.count == 2 ? kContactGap_m - contact.points[1].gap_m : 0};
    const double m00 = first.mobility(0, 0) + second.mobility(0, 0);
    double push[2] = {std::max(0.0, need[0] / m00), 0};
    if (contact.count == 2) {
      // The linear complementarity problem of two points: both, or only the one of them that suffices for both.
      const double m01 = first.mobility(0, 1) + second.mobility(0, 1);
      const double m11 = first.mobility(1, 1) + second.mobility(1, 1);
      const double determinant = m00 * m11 - m01 * m01;
      const double both[2] = {(need[0] * m11 - need[1] * m01) / determinant,
                              (need[1] * m00 - need[0] * m01) / determinant};
      if (determinant > 0 && both[0] >= 0 && both[1] >= 0) {
        push[0] = both[0];
        push[1] = both[1];
      } else if (need[1] > need[0]) {
        push[0] = 0;
        push[1] = need[1] / m11;
      }
    }
    const auto move = [&](std::uint32_t i, const Lever& lever, double sign) {
      auto& pose = to_[i].world_from_object;
      const double sum = sign * (push[0] + push[1]);
      pose.x += contact.normal.x * sum * lever.per_mass;
      pose.y += contact.normal.y * sum * lever.per_mass;
      pose.phi += sign * (push[0] * lever.arm_m[0] + push[1] * lever.arm_m[1]) * lever.per_turn;
    };
    move(pair.first, first, -1);
    if (pair.with == With::object) move(pair.second, second, 1);
  }

  double coverOf(With with, std::uint32_t i) const {
    return with == With::object ? group_.objects[i].body->covering_radius_m : group_.robots[i].disc->radius_m;
  }
  TPoint2D centerOf(const std::vector<ObjectMotion>& motions, const std::vector<TPoint2D>& robots, With with,
                    std::uint32_t i) const {
    if (with != With::object) return robots[i];
    const auto& pose = motions[i].world_from_object;
    return {pose.x, pose.y};
  }

  /// Whether the discs about two bodies come within `gap_m`. Superset of those whose outlines do.
  bool mayTouch(const std::vector<ObjectMotion>& motions, const std::vector<TPoint2D>& robots,
                const PushingGroup::Pair& pair, double gap_m) const {
    const With first = pair.with == With::two_robots ? With::robot : With::object;
    const TPoint2D center = centerOf(motions, robots, first, pair.first);
    const double reach_m = coverOf(first, pair.first) + gap_m;
    if (pair.with == With::stationary) {
      const Outline& outline = group_.stationary[pair.second];
      if (const auto* box = std::get_if<OrientedBox>(&outline)) {
        const TPoint2D way = center - box->center;
        return std::abs(dot(way, box->axis)) <= box->half_length_m + reach_m &&
               std::abs(cross(box->axis, way)) <= box->half_width_m + reach_m;
      }
      const auto& disc = std::get<Circle>(outline);
      const TPoint2D way = center - disc.center;
      return dot(way, way) <= (reach_m + disc.radius_m) * (reach_m + disc.radius_m);
    }
    const TPoint2D way = center - centerOf(motions, robots, pair.with, pair.second);
    const double near_m = reach_m + coverOf(pair.with, pair.second);
    return dot(way, way) <= near_m * near_m;
  }

  /// The first pair, from a number on, that has come too near; the number of pairs if there is none. An object that has
  /// moved too far counts as too near to its first neighbour.
  std::size_t firstOverlap(std::size_t p) const {
    for (; p < group_.pairs.size(); ++p) {
      const auto& pair = group_.pairs[p];
      if (pair.with != With::two_robots && isTooFar(pair.first)) return p;
      if (pair.with == With::object && isTooFar(pair.second)) return p;
      if (!mayTouch(to_, robot_to_, pair, kGapMin_m)) continue;
      const double gap_m = contactOfPair(to_, robot_to_, pair).gap();
      if (gap_m >= kGapMin_m) continue;
      if (gap_m < contactOfPair(from_, robot_from_, pair).gap() - kRounding_m) return p;
    }
    return p;
  }

  bool isTooFar(std::uint32_t i) const {
    const auto& pose = to_[i].world_from_object;
    const double dx = pose.x - start_[i].x;
    const double dy = pose.y - start_[i].y;
    return !(dx * dx + dy * dy <= group_.reach_m * group_.reach_m);
  }

  std::size_t robotNode(std::size_t r) const { return to_.size() + r; }

  /// Bodies that push each other in this part. Stationary solids and robots at rest connect nothing.
  Sets pushedTogether() const {
    Sets sets(to_.size() + stopped_at_.size());
    for (std::size_t p = 0; p < group_.pairs.size(); ++p) {
      const auto& pair = group_.pairs[p];
      if (!active_[p] || pair.with == With::stationary || pair.with == With::two_robots) continue;
      if (pair.with == With::robot && isStopped(pair.second)) continue;
      sets.join(pair.first, pair.with == With::object ? pair.second : robotNode(pair.second));
    }
    return sets;
  }

  /// 4 of the description. @return whether a robot is blocked that was not before
  bool blockOverloaded(double at) {
    if (std::find(active_.begin(), active_.end(), 1) == active_.end()) return false;
    Sets sets = pushedTogether();
    std::vector<double> needed_j(to_.size() + stopped_at_.size()), available_j(needed_j.size());
    for (std::size_t i = 0; i < to_.size(); ++i) needed_j[sets.of(i)] += neededWork(i);
    for (std::size_t r = 0; r < stopped_at_.size(); ++r) {
      const TPoint2D way = robot_to_[r] - robot_from_[r];
      available_j[sets.of(robotNode(r))] += group_.robots[r].disc->push_max_n * std::sqrt(dot(way, way));
    }
    constexpr double kRoundingShare = 1e-6;
    return stopRobots(at, [&](std::size_t r) {
      const std::size_t set = sets.of(robotNode(r));
      return needed_j[set] > available_j[set] * (1 + kRoundingShare);
    });
  }

  /// Work against friction that an object has not paid with its own energy.
  double neededWork(std::size_t i) const {
    const MovableBody& body = *group_.objects[i].body;
    const auto& before = from_[i].world_from_object;
    const auto& after = to_[i].world_from_object;
    const double friction_j = body.friction_n * portable::hypot(portable::hypot(after.x - before.x, after.y - before.y),
                                                                (after.phi - before.phi) * body.turn_radius_m);
    const double paid_j = std::max(0.0, energyOf(body, from_[i]) - energyOf(body, to_[i]));
    return std::max(0.0, friction_j - paid_j);
  }

  static double energyOf(const MovableBody& body, const ObjectMotion& motion) {
    const double speed = speedOf(body, motion);
    return body.mass_kg * speed * speed / 2;
  }

  template <typename Blocked>
  bool stopRobots(double at, const Blocked& is_blocked) {
    bool has_stopped = false;
    for (std::size_t r = 0; r < stopped_at_.size(); ++r) {
      if (isStopped(r) || !is_blocked(r)) continue;
      stopped_at_[r] = at;
      has_stopped = true;
    }
    return has_stopped;
  }

  /// The end of 5 of the description: what pushes each other where bodies overlap stays where it is.
  void holdJammed(double at) {
    for (std::size_t p = firstOverlap(0); p < group_.pairs.size(); p = firstOverlap(0)) {
      const auto& pair = group_.pairs[p];
      Sets sets = pushedTogether();
      const std::size_t first =
          sets.of(pair.with == With::two_robots ? robotNode(pair.first) : std::size_t{pair.first});
      std::size_t second = first;
      if (pair.with == With::object) second = sets.of(pair.second);
      if (pair.with == With::robot || pair.with == With::two_robots) second = sets.of(robotNode(pair.second));
      const auto is_held = [&](std::size_t node) {
        const std::size_t set = sets.of(node);
        return set == first || set == second;
      };
      for (std::size_t i = 0; i < to_.size(); ++i) {
        if (is_held(i)) to_[i] = {{}, from_[i].world_from_object};
      }
      stopRobots(at, [&](std::size_t r) { return is_held(robotNode(r)); });
      for (std::size_t r = 0; r < stopped_at_.size(); ++r) {
        if (is_held(robotNode(r))) robot_to_[r] = robot_from_[r];
      }
    }
  }

  PushingGroup& group_;
  double period_s_;
  double duration_s_ = 0;           ///< of this part
  std::vector<double> stopped_at_;  ///< fraction of its path at which a robot ends
  std::vector<TPoint2D> robot_from_, robot_to_;
  std::vector<mrpt::math::TPose2D> start_;  ///< of the objects in this step
  std::vector<ObjectMotion> from_, to_;     ///< at both ends of this part
  std::vector<std::uint8_t> active_;        ///< by pair: has pushed in this part
  std::vector<std::uint8_t> is_pushed_;     ///< by object: has got an impulse in this part
  std::vector<ActiveContact> contacts_;
};

}  // namespace

void Pushing::move(PushingGroup& group, double period_s) { PushingStep(group, period_s).run(); }

}  // namespace robosim
