#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "dynamics/contact.h"
#include "dynamics/pushing.h"

namespace robosim {

/// Bodies nearer than this touch: they exchange impulses [m].
constexpr double kTouch_m = 3 * kContactGap_m;

/// Where the bodies of a group are at a time of a step, and how the objects move.
struct GroupMoment {
  std::vector<ObjectMotion> objects;
  std::vector<Outline> outlines;             ///< of the objects; outline() after a change of a pose
  std::vector<mrpt::math::TPoint2D> robots;  ///< centres
};

/// Bodies of a group that may touch each other in a part of a step, and no others.
struct Island {
  std::vector<std::uint32_t> objects, robots, pairs;  ///< ascending indices of PushingGroup's
};

/// What an impulse along the normal of a contact does to one of its bodies: how fast the contact's points move along
/// the normal, per impulse. The inertia about the centre is that of MovableBody.
struct Lever {
  double per_mass = 0;  ///< 1 / mass; 0 for a body that does not give way
  double per_turn = 0;  ///< 1 / (mass · turn_radius²)
  double arm_m[2]{};    ///< of the contact's points
  double mobility(int i, int j) const { return per_mass + per_turn * arm_m[i] * arm_m[j]; }
};

/// Makes the outline of an object that of its pose.
void outline(const PushingGroup& group, std::uint32_t object, GroupMoment& moment);

/// The contact of a pair, from its first body to its second.
Contact contactOf(const PushingGroup& group, const GroupMoment& moment, const PushingGroup::Pair& pair);
/// Whether the bodies of a pair may come within `gap_m`: a superset of those that do, at a fraction of the cost.
bool mayTouch(const PushingGroup& group, const GroupMoment& moment, const PushingGroup::Pair& pair, double gap_m);
/// @param body the first or second of a pair, and its kind
Lever leverOf(const PushingGroup& group, const GroupMoment& moment, PushingGroup::Pair::With kind, std::uint32_t body,
              const Contact& contact);
/// Velocity of the floor at the centre of an object, which is that of a belt or 0 [m/s].
mrpt::math::TPoint2D floorVelocityUnder(const PushingGroup& group, const ObjectMotion& motion);
/// Speed in the length in which friction is equal in all directions: (x, y, turn_radius · turn) [m/s].
double speedOf(const MovableBody& body, const ObjectSpeed& speed);

}  // namespace robosim
