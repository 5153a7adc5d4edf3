#include "hardware/camera_head.h"

#include <algorithm>

namespace robosim {

CameraAim limited(const CameraAim& aim, const CameraHeadLimits& limits) {
  // Plus 0, which makes 0 of -0: the digest distinguishes them, saved commands do not.
  return {std::clamp(aim.pan_rad, limits.pan_min_rad, limits.pan_max_rad) + 0.0,
          std::clamp(aim.tilt_rad, limits.tilt_min_rad, limits.tilt_max_rad) + 0.0,
          std::clamp(aim.zoom, 1.0, limits.zoom_max)};
}

mrpt::math::TPose3D aimed(mrpt::math::TPose3D robot_from_mount, const CameraAim& aim) {
  robot_from_mount.yaw += aim.pan_rad;
  robot_from_mount.pitch -= aim.tilt_rad;  // MRPT's pitch is positive downwards
  return robot_from_mount;
}

CameraInfo zoomed(CameraInfo camera, double zoom) {
  camera.field_of_view_rad /= zoom;
  return camera;
}

SensorInfo aimed(SensorInfo camera, const CameraAim& aim) {
  for (Beam& mount : camera.beams) mount.robot_from_beam = aimed(mount.robot_from_beam, aim);
  camera.camera = zoomed(camera.camera, aim.zoom);
  return camera;
}

std::optional<std::size_t> cameraHeadIn(const std::vector<SensorInfo>& sensors) {
  const auto found = std::find_if(sensors.begin(), sensors.end(), CameraAim::isOf);
  if (found == sensors.end()) return std::nullopt;
  return static_cast<std::size_t>(found - sensors.begin());
}

std::optional<CameraAim> aimOf(const SensorInfo& camera, const std::vector<SensorInfo>& sensors,
                               const std::vector<Measurement>& measurements) {
  const bool shows = camera.kind == SensorKind::camera || camera.kind == SensorKind::blob_finder;
  if (!shows || !camera.pans) return std::nullopt;
  const auto head = cameraHeadIn(sensors);
  if (!head || *head >= measurements.size()) return std::nullopt;
  const auto* const values = std::get_if<Values>(&measurements[*head]);
  if (!values || values->values.size() != CameraAim::quantities().size()) return std::nullopt;
  return CameraAim::from(*values);
}

}  // namespace robosim
