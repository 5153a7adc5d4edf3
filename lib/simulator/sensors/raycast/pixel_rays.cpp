#include "sensors/raycast/pixel_rays.h"

#include "base/portable_math.h"

namespace robosim {

CameraAxes CameraAxes::of(const mrpt::math::TPose3D& robot_from_camera) {
  // MRPT's order: roll about x, then pitch about y, positive downwards, then yaw about z.
  const auto [sin_yaw, cos_yaw] = portable::sincos(robot_from_camera.yaw);
  const auto [sin_pitch, cos_pitch] = portable::sincos(robot_from_camera.pitch);
  const auto [sin_roll, cos_roll] = portable::sincos(robot_from_camera.roll);
  return {{cos_yaw * cos_pitch, sin_yaw * cos_pitch, -sin_pitch},
          {cos_yaw * sin_pitch * sin_roll - sin_yaw * cos_roll, sin_yaw * sin_pitch * sin_roll + cos_yaw * cos_roll,
           cos_pitch * sin_roll},
          {cos_yaw * sin_pitch * cos_roll + sin_yaw * sin_roll, sin_yaw * sin_pitch * cos_roll - cos_yaw * sin_roll,
           cos_pitch * cos_roll}};
}

PixelRays::Offset PixelRays::of(std::uint32_t column, std::uint32_t row) const {
  const Offset shown{left(column), up(row)};
  if (info_.distortion.isNone()) return shown;
  // Points of LensDistortion have x to the right and y down.
  LensDistortion::Point ideal;
  if (!info_.distortion.undistort({-shown.left, -shown.up}, ideal)) return shown;
  return {-ideal.x, -ideal.y};
}

}  // namespace robosim
