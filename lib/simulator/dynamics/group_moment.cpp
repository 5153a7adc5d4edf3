#include "dynamics/group_moment.h"

#include <cmath>

#include "base/portable_math.h"
#include "geometry/shapes/planar_vector.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using With = PushingGroup::Pair::With;

With kindOfFirst(const PushingGroup::Pair& pair) { return pair.with == With::two_robots ? With::robot : With::object; }

TPoint2D centerOf(const GroupMoment& moment, With kind, std::uint32_t i) {
  if (kind != With::object) return moment.robots[i];
  const auto& pose = moment.objects[i].world_from_object;
  return {pose.x, pose.y};
}

double coverOf(const PushingGroup& group, With kind, std::uint32_t i) {
  return kind == With::object ? group.objects[i].body->covering_radius_m : group.robots[i].disc->radius_m;
}

}  // namespace

void outline(const PushingGroup& group, std::uint32_t object, GroupMoment& moment) {
  moment.outlines[object] = group.objects[object].body->outlineAt(moment.objects[object].world_from_object);
}

Contact contactOf(const PushingGroup& group, const GroupMoment& moment, const PushingGroup::Pair& pair) {
  const auto disc = [&](std::uint32_t robot) -> Outline {
    return Circle{moment.robots[robot], group.robots[robot].disc->radius_m};
  };
  switch (pair.with) {
    case With::object:
      return contactOf(moment.outlines[pair.first], moment.outlines[pair.second]);
    case With::stationary:
      return contactOf(moment.outlines[pair.first], group.stationary[pair.second]);
    case With::robot:
      return contactOf(moment.outlines[pair.first], disc(pair.second));
    default:
      return contactOf(disc(pair.first), disc(pair.second));
  }
}

bool mayTouch(const PushingGroup& group, const GroupMoment& moment, const PushingGroup::Pair& pair, double gap_m) {
  const With first = kindOfFirst(pair);
  const TPoint2D center = centerOf(moment, first, pair.first);
  const double reach_m = coverOf(group, first, pair.first) + gap_m;
  if (pair.with != With::stationary) {
    return isWithin(center, centerOf(moment, pair.with, pair.second), reach_m + coverOf(group, pair.with, pair.second));
  }
  const Outline& outline = group.stationary[pair.second];
  if (const auto* disc = std::get_if<Circle>(&outline)) return isWithin(center, disc->center, reach_m + disc->radius_m);
  const auto& box = std::get<OrientedBox>(outline);
  const TPoint2D way = center - box.center;
  return std::abs(dot(way, box.axis)) <= box.half_length_m + reach_m &&
         std::abs(cross(box.axis, way)) <= box.half_width_m + reach_m;
}

Lever leverOf(const PushingGroup& group, const GroupMoment& moment, With kind, std::uint32_t body,
              const Contact& contact) {
  if (kind != With::object) return {};
  const MovableBody& object = *group.objects[body].body;
  const TPoint2D center = centerOf(moment, kind, body);
  return {1 / object.mass_kg,
          1 / (object.mass_kg * object.turn_radius_m * object.turn_radius_m),
          {cross(contact.points[0].at - center, contact.normal), cross(contact.points[1].at - center, contact.normal)}};
}

TPoint2D floorVelocityUnder(const PushingGroup& group, const ObjectMotion& motion) {
  for (const Belt& belt : group.belts) {
    if (belt.carries({motion.world_from_object.x, motion.world_from_object.y})) return belt.velocity_mps;
  }
  return {0, 0};
}

double speedOf(const MovableBody& body, const ObjectSpeed& speed) {
  return portable::hypot(portable::hypot(speed.vx_mps, speed.vy_mps), speed.turn_radps * body.turn_radius_m);
}

}  // namespace robosim
