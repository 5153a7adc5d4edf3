#pragma once
#include <cstdint>

#include "sensors/raycast/camera.h"
#include "sensors/raycast/pixel_rays.h"

namespace robosim {

/// What a ray hits.
struct SlowSight {
  double depth_m = 0;  ///< along the optical axis; 0 for the sky
  std::uint32_t body = RaycastPicture::kSky;
  Rgb color{};
};

/// Reference implementation of ray-cast pictures: for each pixel, one ray that is intersected with one body after
/// another.
class SlowRaycast {
 public:
  SlowRaycast(const CameraInfo& info, const mrpt::math::TPose3D& robot_from_camera, double range_max_m,
              const SeenScene& seen, const PlanarTransform& world_from_robot, BodyId owner);

  SlowSight at(std::uint32_t column, std::uint32_t row) const;
  /// What is seen at an offset from the optical axis at a depth of 1 m.
  SlowSight along(double left, double up) const;

 private:
  PixelRays rays_;
  double focal_px_, range_max_m_;
  SeenScene seen_;
  BodyId owner_;
  mrpt::math::TPoint3D origin_;
  CameraAxes axes_;
};

}  // namespace robosim
