#include "dynamics/held_object.h"

#include <algorithm>

#include "base/portable_math.h"
#include "base/portable_pose.h"

namespace robosim {

mrpt::math::TPose2D HeldObject::poseAt(const mrpt::math::TPose2D& world_from_robot) const {
  const auto center =
      portable::compose(world_from_robot, mrpt::math::TPoint2D(robot_from_object.x, robot_from_object.y));
  return {center.x, center.y, world_from_robot.phi + robot_from_object.phi};
}

Path HeldObject::pathOf(const Path& of_robot) const {
  Path path = of_robot;
  const auto start = poseAt(of_robot.world_from_start);
  // The velocity of the point in the robot's frame is constant: (v - ω·y, ω·x).
  double ahead_m = of_robot.length_m - of_robot.turn_rad * robot_from_object.y;
  double aside_m = of_robot.turn_rad * robot_from_object.x;
  if (of_robot.direction_rad != 0) {
    const auto [sin, cos] = portable::sincos(of_robot.direction_rad);
    ahead_m += of_robot.length_m * (cos - 1);
    aside_m += of_robot.length_m * sin;
    path.direction_rad = 0;
  }
  path.world_from_start = {start.x, start.y, of_robot.world_from_start.phi + portable::atan2(aside_m, ahead_m)};
  path.length_m = portable::hypot(ahead_m, aside_m);
  return path;
}

double HeldObject::extent() const { return portable::hypot(robot_from_object.x, robot_from_object.y) + radius_m; }

const HeldObject* heldBy(std::span<const HeldObject> held, std::size_t robot) {
  if (held.empty()) return nullptr;
  const auto found = std::lower_bound(held.begin(), held.end(), robot,
                                      [](const HeldObject& one, std::size_t of) { return one.robot < of; });
  return found != held.end() && found->robot == robot ? &*found : nullptr;
}

std::optional<std::uint32_t> heldIndexOf(std::span<const HeldObject> held, std::size_t object) {
  for (std::uint32_t h = 0; h < held.size(); ++h) {
    if (held[h].object == object) return h;
  }
  return std::nullopt;
}

}  // namespace robosim
