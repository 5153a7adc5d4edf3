#include "sensors/testing/slow_raycast.h"

#include <cmath>
#include <limits>

#include "geometry/testing/slow_scene.h"
#include "sensors/raycast/surface_light.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

PackedRgb colorOf(const SeenScene& seen, const Hit& hit, const Ray& ray) {
  constexpr double kTouch_m = 1e-9;
  const auto i = static_cast<std::size_t>(hit.body);
  const SurfaceLook look = i < seen.looks.size() ? seen.looks[i] : SurfaceLook{};
  const Solid solid = seen.scene.solid(hit.body);
  if (ray.direction.z < 0 && std::abs(hit.point.z - solid.heights.z_max_m) < kTouch_m) return lit(look, kTopLight);
  if (ray.direction.z > 0 && std::abs(hit.point.z - solid.heights.z_min_m) < kTouch_m) {
    return lit(look, kUndersideLight);
  }
  const auto normal = normalAt(solid.outline, {hit.point.x, hit.point.y});
  return lit(look, sideLight(static_cast<float>(normal.x * static_cast<double>(kTowardsSun[0]) +
                                                normal.y * static_cast<double>(kTowardsSun[1]))));
}

/// @param per_pixel length that a pixel covers, over the square of its depth
PackedRgb floorColor(const FloorLook& floor, const TPoint2D& place, double depth_m, double per_pixel) {
  if (const auto color = paintAt(floor, place)) return *color;
  if (!floor.bounds.contains(place)) return packed(kGroundColor);
  const auto fields = fieldColors(static_cast<float>(depth_m * depth_m * per_pixel));
  return isBrightField(place.x, place.y) ? fields.bright : fields.dark;
}

}  // namespace

SlowRaycast::SlowRaycast(const CameraInfo& info, const mrpt::math::TPose3D& robot_from_camera, double range_max_m,
                         const SeenScene& seen, const PlanarTransform& world_from_robot, BodyId owner)
    : rays_(info),
      focal_px_(info.focalLength()),
      range_max_m_(range_max_m),
      seen_(seen),
      owner_(owner),
      origin_(world_from_robot.pointToWorld(TPoint3D(robot_from_camera.x, robot_from_camera.y, robot_from_camera.z))) {
  const CameraAxes axes = CameraAxes::of(robot_from_camera);
  axes_ = {world_from_robot.turnToWorld(axes.ahead), world_from_robot.turnToWorld(axes.left),
           world_from_robot.turnToWorld(axes.up)};
}

SlowSight SlowRaycast::at(std::uint32_t column, std::uint32_t row) const {
  const auto offset = rays_.of(column, row);
  return along(offset.left, offset.up);
}

SlowSight SlowRaycast::along(double left, double up) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const TPoint3D way = axes_.ahead + axes_.left * left + axes_.up * up;
  const double length = way.norm();
  const Ray ray{origin_, way * (1 / length)};
  const Hit hit = castRaySlowly(seen_.scene, ray, kInfinity, owner_);
  const double depth_m = hit.distance_m / length;
  const double floor_m = origin_.z > 0 && way.z < 0 ? -origin_.z / way.z : kInfinity;
  SlowSight sight;
  PackedRgb color = 0;
  if (hit && depth_m <= floor_m && depth_m <= range_max_m_) {
    sight.depth_m = depth_m;
    sight.body = static_cast<std::uint32_t>(hit.body);
    color = colorOf(seen_, hit, ray);
  } else if (floor_m < kInfinity && floor_m <= range_max_m_) {
    sight.depth_m = floor_m;
    sight.body = RaycastPicture::kFloor;
    const TPoint3D place = origin_ + way * floor_m;
    color = floorColor(seen_.floor, {place.x, place.y}, floor_m, 1 / (focal_px_ * origin_.z));
  } else {
    color = skyColor(static_cast<float>(ray.direction.z));
  }
  sight.color = {static_cast<std::uint8_t>(color), static_cast<std::uint8_t>(color >> 8),
                 static_cast<std::uint8_t>(color >> 16)};
  return sight;
}

}  // namespace robosim
