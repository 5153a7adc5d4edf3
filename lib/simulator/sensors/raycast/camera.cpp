#include "sensors/raycast/camera.h"

#include "sensors/raycast/picture_job.h"

namespace robosim {

struct RaycastCamera::Impl {
  mrpt::math::TPoint3D robot_from_origin;
  RaycastOptions options;
  PictureGeometry geometry;
};

RaycastCamera::RaycastCamera(const CameraInfo& info, const mrpt::math::TPose3D& robot_from_camera,
                             const RaycastOptions& options)
    : impl_(std::make_unique<Impl>(Impl{{robot_from_camera.x, robot_from_camera.y, robot_from_camera.z},
                                        options,
                                        {info, CameraAxes::of(robot_from_camera), options.range_max_m}})) {}
RaycastCamera::~RaycastCamera() = default;
RaycastCamera::RaycastCamera(RaycastCamera&&) noexcept = default;
RaycastCamera& RaycastCamera::operator=(RaycastCamera&&) noexcept = default;

void RaycastCamera::take(const SeenScene& seen, const PlanarTransform& world_from_robot, BodyId owner,
                         RaycastPicture& picture) const {
  static thread_local PictureScratch scratch;
  const PictureGeometry& camera = impl_->geometry;
  const std::size_t pixels = std::size_t{camera.width_px} * camera.height_px;
  picture.width_px = camera.width_px;
  picture.height_px = camera.height_px;
  picture.rgb.resize(impl_->options.has_rgb ? 3 * pixels : 0);
  picture.depth_m.resize(impl_->options.has_depth ? pixels : 0);
  picture.body.resize(impl_->options.has_body ? pixels : 0);

  const auto origin = world_from_robot.pointToWorld(impl_->robot_from_origin);
  const auto ahead = world_from_robot.turnToWorld(camera.is_level ? camera.axes.ahead : mrpt::math::TPoint3D(1, 0, 0));
  const ViewFrame frame{origin.x, origin.y, origin.z, ahead.x, ahead.y};
  const auto sun = frame.toView({static_cast<double>(kTowardsSun[0]), static_cast<double>(kTowardsSun[1])});
  const PictureJob job{.camera = &camera,
                       .seen = &seen,
                       .owner = owner,
                       .frame = frame,
                       .sun_x = static_cast<float>(sun.x),
                       .sun_y = static_cast<float>(sun.y),
                       .floor_m = origin.z > 0 ? -origin.z : -std::numeric_limits<double>::infinity(),
                       .scratch = &scratch,
                       .picture = &picture};
  if (camera.is_level) {
    takeLevelPicture(job);
  } else {
    takeTiltedPicture(job);
  }
}

}  // namespace robosim
