#include "dynamics/impulses.h"

#include <algorithm>
#include <cmath>

#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using With = PushingGroup::Pair::With;

constexpr int kBouncesMax = 32, kImpulseSweepsMax = 500;
/// Below this, two bodies do not approach each other [m/s].
constexpr double kApproachMin_mps = 1e-10;

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
    const auto mobility_of = [&](const Contact& of, int i) {
      return leverOf(group_, from_, With::object, pair.first, of).mobility(i, i) +
             leverOf(group_, from_, pair.with, pair.second, of).mobility(i, i);
    };
    Contact of_middle = contact;
    of_middle.points[0].at = middleOf(contact);
    touches_.push_back({.pair = p,
                        .contact = contact,
                        .mobility = {mobility_of(contact, 0), mobility_of(contact, 1)},
                        .middle = of_middle.points[0].at,
                        .mobility_of_middle = mobility_of(of_middle, 0)});
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
      const double speed = separation(objects, touch, touch.middle);
      if (speed > -Pushing::kBounceMin_mps) continue;
      apply(touch, touch.middle, -(1 + restitution) * speed / touch.mobility_of_middle, objects, pushed);
      pushing[touch.pair] = 1;
      has_bounced = true;
    }
    if (!has_bounced) return;
  }
}

/// Solves for the impulses after which no touching points approach each other (projected Gauss-Seidel). Each single
/// change decreases the energy of objects among themselves.
void Impulses::stopApproaches(std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushed) {
  for (int sweep = 0; sweep < kImpulseSweepsMax; ++sweep) {
    double fastest_mps = 0;
    for (Touch& touch : touches_) {
      for (int i = 0; i < touch.contact.count; ++i) {
        const Contact::Point& point = touch.contact.points[static_cast<std::size_t>(i)];
        if (point.gap_m > kTouch_m) continue;
        const double needed_ns = -separation(objects, touch, point.at) / touch.mobility[i];
        const double impulse_ns = std::max(-touch.impulse_ns[i], needed_ns);
        if (impulse_ns == 0) continue;
        touch.impulse_ns[i] += impulse_ns;
        apply(touch, point.at, impulse_ns, objects, pushed);
        fastest_mps = std::max(fastest_mps, std::abs(impulse_ns) * touch.mobility[i]);
      }
    }
    if (fastest_mps <= kApproachMin_mps) return;
  }
}

TPoint2D Impulses::velocityAt(const std::vector<ObjectMotion>& objects, With kind, std::uint32_t body,
                              const TPoint2D& point) const {
  if (kind == With::stationary) return {};
  if (kind == With::robot) return (robots_to_[body] - from_.robots[body]) * (1 / duration_s_);
  const ObjectMotion& motion = objects[body];
  const TPoint2D arm(point.x - motion.world_from_object.x, point.y - motion.world_from_object.y);
  return {motion.vx_mps - motion.turn_radps * arm.y, motion.vy_mps + motion.turn_radps * arm.x};
}

/// Speed at which the bodies of a contact move away from each other at a point.
double Impulses::separation(const std::vector<ObjectMotion>& objects, const Touch& touch, const TPoint2D& at) const {
  const auto& pair = group_.pairs[touch.pair];
  return dot(velocityAt(objects, pair.with, pair.second, at) - velocityAt(objects, With::object, pair.first, at),
             touch.contact.normal);
}

void Impulses::apply(const Touch& touch, const TPoint2D& at, double impulse_ns, std::vector<ObjectMotion>& objects,
                     std::vector<std::uint8_t>& pushed) const {
  const TPoint2D& normal = touch.contact.normal;
  const auto push = [&](std::uint32_t i, double signed_ns) {
    const MovableBody& body = *group_.objects[i].body;
    ObjectMotion& motion = objects[i];
    const TPoint2D arm(at.x - motion.world_from_object.x, at.y - motion.world_from_object.y);
    motion.vx_mps += normal.x * signed_ns / body.mass_kg;
    motion.vy_mps += normal.y * signed_ns / body.mass_kg;
    motion.turn_radps += cross(arm, normal) * signed_ns / (body.mass_kg * body.turn_radius_m * body.turn_radius_m);
    pushed[i] = 1;
  };
  const auto& pair = group_.pairs[touch.pair];
  push(pair.first, -impulse_ns);
  if (pair.with == With::object) push(pair.second, impulse_ns);
}

double Impulses::restitutionOf(const PushingGroup::Pair& pair) const {
  const double of_first = group_.objects[pair.first].body->restitution;
  return pair.with == With::object ? std::max(of_first, group_.objects[pair.second].body->restitution) : of_first;
}

}  // namespace robosim
