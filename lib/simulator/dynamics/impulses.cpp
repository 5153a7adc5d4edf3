#include "dynamics/impulses.h"

#include <algorithm>
#include <cmath>

#include "dynamics/convergence.h"
#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using With = PushingGroup::Pair::With;

constexpr int kBouncesMax = 32, kImpulseSweepsMax = 500;
/// Below this, two bodies do not approach each other [m/s].
constexpr double kApproachMin_mps = 1e-9;

TPoint2D middleOf(const Contact& contact) {
  const auto& points = contact.points;
  if (contact.count == 1 || points[1].gap_m > kTouch_m) return points[0].at;
  if (points[0].gap_m > kTouch_m) return points[1].at;
  return (points[0].at + points[1].at) * 0.5;
}

}  // namespace

Impulses::Impulses(const PushingGroup& group, const Island& island, const GroupMoment& from,
                   const std::vector<TPoint2D>& robots_to, double duration_s)
    : group_(group), from_(from), robots_to_(robots_to), duration_s_(duration_s) {
  findTouches(island);
}

void Impulses::exchange(std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushing,
                        std::vector<std::uint8_t>& pushed) {
  bounce(objects, pushing, pushed);
  stopApproaches(objects, pushed);
  for (const Touch& touch : touches_) {
    if (touch.impulse_ns[0] > 0 || touch.impulse_ns[1] > 0) pushing[touch.pair] = 1;
  }
}

void Impulses::findTouches(const Island& island) {
  for (const std::uint32_t p : island.pairs) {
    const auto& pair = group_.pairs[p];
    if (pair.with == With::two_robots || !mayTouch(group_, from_, pair, kTouch_m)) continue;
    const Contact contact = contactOf(group_, from_, pair);
    if (contact.gap() > kTouch_m) continue;
    Contact of_middle = contact;
    of_middle.points[0].at = of_middle.points[1].at = middleOf(contact);
    const auto side = [&](With kind, std::uint32_t body) {
      return Side{leverOf(group_, from_, kind, body, contact), leverOf(group_, from_, kind, body, of_middle)};
    };
    touches_.push_back({.pair = p,
                        .contact = contact,
                        .first = side(With::object, pair.first),
                        .second = side(pair.with, pair.second)});
    if (pair.with == With::robot) {
      const TPoint2D way = robots_to_[pair.second] - from_.robots[pair.second];
      touches_.back().robot_mps = dot(way, contact.normal) / duration_s_;
    }
  }
}

/// One pair after the other: none of these collisions increases the energy of objects among themselves.
void Impulses::bounce(std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushing,
                      std::vector<std::uint8_t>& pushed) const {
  for (int round = 0; round < kBouncesMax; ++round) {
    bool has_bounced = false;
    for (const Touch& touch : touches_) {
      const double restitution = restitutionOf(group_.pairs[touch.pair]);
      if (restitution == 0) continue;
      const Lever& first = touch.first.at_middle;
      const Lever& second = touch.second.at_middle;
      const double speed = separation(objects, touch, first, second, 0);
      if (speed > -Pushing::kBounceMin_mps) continue;
      const double mobility = first.mobility(0, 0) + second.mobility(0, 0);
      if (mobility == 0) continue;
      apply(touch, first, second, 0, -(1 + restitution) * speed / mobility, objects, pushed);
      pushing[touch.pair] = 1;
      has_bounced = true;
    }
    if (!has_bounced) return;
  }
}

/// Solves for the impulses after which no touching points approach each other (projected Gauss-Seidel). Each single
/// change decreases the energy of objects among themselves.
void Impulses::stopApproaches(std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushed) {
  Convergence progress;
  for (int sweep = 0; sweep < kImpulseSweepsMax; ++sweep) {
    double fastest_mps = 0;
    for (Touch& touch : touches_) {
      const Lever& first = touch.first.at_points;
      const Lever& second = touch.second.at_points;
      for (int i = 0; i < touch.contact.count; ++i) {
        if (touch.contact.points[static_cast<std::size_t>(i)].gap_m > kTouch_m) continue;
        const double mobility = first.mobility(i, i) + second.mobility(i, i);
        if (mobility == 0) continue;  // neither gives way: a door and a robot
        const double needed_ns = -separation(objects, touch, first, second, i) / mobility;
        const double impulse_ns = std::max(-touch.impulse_ns[i], needed_ns);
        if (impulse_ns == 0) continue;
        touch.impulse_ns[i] += impulse_ns;
        apply(touch, first, second, i, impulse_ns, objects, pushed);
        fastest_mps = std::max(fastest_mps, std::abs(impulse_ns) * mobility);
      }
    }
    if (progress.isOver(fastest_mps <= kApproachMin_mps ? 0 : fastest_mps)) return;
  }
}

/// Speed at which the bodies of a contact move away from each other at a point of the levers.
double Impulses::separation(const std::vector<ObjectMotion>& objects, const Touch& touch, const Lever& first,
                            const Lever& second, int point) const {
  const auto along = [&](std::uint32_t i, const Lever& lever) {
    const ObjectMotion& motion = objects[i];
    return motion.vx_mps * touch.contact.normal.x + motion.vy_mps * touch.contact.normal.y +
           motion.turn_radps * lever.arm_m[point];
  };
  const auto& pair = group_.pairs[touch.pair];
  return (pair.with == With::object ? along(pair.second, second) : touch.robot_mps) - along(pair.first, first);
}

void Impulses::apply(const Touch& touch, const Lever& first, const Lever& second, int point, double impulse_ns,
                     std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushed) const {
  const auto push = [&](std::uint32_t i, const Lever& lever, double signed_ns) {
    ObjectMotion& motion = objects[i];
    motion.vx_mps += touch.contact.normal.x * signed_ns * lever.per_mass;
    motion.vy_mps += touch.contact.normal.y * signed_ns * lever.per_mass;
    motion.turn_radps += lever.arm_m[point] * signed_ns * lever.per_turn;
    pushed[i] = 1;
  };
  const auto& pair = group_.pairs[touch.pair];
  push(pair.first, first, -impulse_ns);
  if (pair.with == With::object) push(pair.second, second, impulse_ns);
}

double Impulses::restitutionOf(const PushingGroup::Pair& pair) const {
  const double of_first = group_.objects[pair.first].body->restitution;
  return pair.with == With::object ? std::max(of_first, group_.objects[pair.second].body->restitution) : of_first;
}

}  // namespace robosim
