#pragma once
#include <memory>

#include <mrpt/math/TPose3D.h>

#include "geometry/shapes/planar_transform.h"
#include "hardware/sensor_info.h"
#include "sensors/raycast/picture.h"

namespace robosim {

/// Takes pictures of a Scene by ray casting: one ray through the centre of each pixel, which shows the nearest surface
/// of a solid or of the floor that it hits. Pictures have the same bits on every processor.
///
/// Shading is flat: a fixed light from the sun and the sky, without shadows. From inside a solid, all pixels show it at
/// depth 0. Of surfaces whose depths are equal in single precision either may be shown.
class RaycastCamera {
 public:
  /// @param info with the distortion of its lens
  /// @param robot_from_camera x along the optical axis, z up
  RaycastCamera(const CameraInfo& info, const mrpt::math::TPose3D& robot_from_camera, const RaycastOptions& options);
  ~RaycastCamera();
  RaycastCamera(RaycastCamera&&) noexcept;
  RaycastCamera& operator=(RaycastCamera&&) noexcept;

  /// Replaces `picture`. Thread-safe for different pictures; allocates no memory for a picture of the same size.
  /// @param world_from_robot at the height of the robot's underside  @param owner is not visible
  void take(const SeenScene& seen, const PlanarTransform& world_from_robot, BodyId owner,
            RaycastPicture& picture) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
