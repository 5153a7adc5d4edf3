#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TPose3D.h>

#include "hardware/camera_head.h"
#include "hardware/command.h"
#include "hardware/measurement.h"
#include "hardware/sensor_info.h"
#include "sensors/camera_errors.h"
#include "world/changed_objects.h"

namespace robosim {

/// A camera and its mounting pose on the robots of a model.
struct CameraView {
  CameraInfo info;
  mrpt::math::TPose3D robot_from_camera;  ///< x along the optical axis, z up
  int jpeg_quality = 85;                  ///< [1, 100]
  bool is_antialiased = false;            ///< rendered at twice the resolution, and averaged
  CameraErrors errors = {};
  CameraMoment moment = {};          ///< of the pictures of a call of take(); empty for a camera without errors
  std::vector<CameraAim> aims = {};  ///< of the pictures of a call of take(); empty for a camera without a head

  bool hasErrors() const { return !errors.isNone() || !info.distortion.isNone(); }
  /// The camera of one picture of a call of take() by a camera with a head: as if it was mounted with this aim.
  CameraView aimedFor(std::size_t picture) const {
    const CameraAim& aim = aims[picture];
    return {zoomed(info, aim.zoom), aimed(robot_from_camera, aim), jpeg_quality, is_antialiased, errors};
  }
};

/// Pose of a robot that is not in the world: it is not drawn.
inline const mrpt::math::TPose2D kNotShown{std::numeric_limits<double>::quiet_NaN(), 0, 0};

/// The poses, with kNotShown for absent robots. @param activity by robot, or empty: all are present
inline std::vector<mrpt::math::TPose2D> shownPoses(std::span<const mrpt::math::TPose2D> world_from_robot,
                                                   std::span<const Activity> activity) {
  std::vector<mrpt::math::TPose2D> shown(world_from_robot.begin(), world_from_robot.end());
  for (std::size_t i = 0; i < activity.size(); ++i) {
    if (activity[i] == Activity::absent) shown[i] = kNotShown;
  }
  return shown;
}

/// What there is to see at an instant.
struct SeenWorld {
  SeenWorld() = default;
  SeenWorld(std::span<const mrpt::math::TPose2D> poses, ChangedObjects changed = {})
      : world_from_robot(poses), objects(std::move(changed)) {}
  SeenWorld(const std::vector<mrpt::math::TPose2D>& poses, ChangedObjects changed = {})
      : SeenWorld(std::span(poses), std::move(changed)) {}

  /// Of all robots, in the world's order; kNotShown for absent ones.
  std::span<const mrpt::math::TPose2D> world_from_robot;
  ChangedObjects objects;
};

struct TargetColor;  // sensors/blob_finder.h

/// Interface that renders and searches the pictures of cameras. One source serves all cameras of a run.
class ImageSource {
 public:
  virtual ~ImageSource() = default;

  /// Takes a picture with the camera of each of `robots`, all at one instant. Thread-safe.
  /// @param jpegs one per element of `robots`; replaced by the bytes of a JPEG file
  virtual void take(const CameraView& camera, const SeenWorld& seen, std::span<const std::uint32_t> robots,
                    std::span<std::string> jpegs) = 0;

  /// The largest blob of each colour in a picture of take(). Thread-safe.
  /// @param pixels_min smaller blobs are ignored
  virtual std::vector<Blob> findBlobs(const std::string& jpeg, const std::vector<TargetColor>& colors,
                                      unsigned pixels_min) = 0;
};

}  // namespace robosim
