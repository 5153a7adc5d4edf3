#include "sensors/sonar_interference.h"

#include "base/portable_math.h"

namespace robosim {

bool mayReceivePing(const Snapshot& now, std::uint32_t robot, const Ray& axis, double half_rad, double range_max_m) {
  static thread_local std::vector<std::uint32_t> found;
  now.scene.findMoving({axis.origin.x, axis.origin.y}, range_max_m, now.world_from_robot.size(), found);
  const double ahead_min = portable::cos(half_rad);
  for (const auto other : found) {
    if (other == robot) continue;
    const auto& pose = now.world_from_robot[other];
    const mrpt::math::TPoint3D out{pose.x - axis.origin.x, pose.y - axis.origin.y, 0};
    const double distance_m = portable::hypot(out.x, out.y);
    if (distance_m == 0 || distance_m > range_max_m) continue;
    const mrpt::math::TPoint3D towards = out * (1 / distance_m);
    if (towards.x * axis.direction.x + towards.y * axis.direction.y < ahead_min) continue;
    if (now.scene.castRay({axis.origin, towards}, distance_m, now.bodyOf(robot)).body == now.bodyOf(other)) return true;
  }
  return false;
}

}  // namespace robosim
