#pragma once
#include <cstdint>
#include <span>
#include <string>

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TPose3D.h>

#include "hardware/sensor_info.h"

namespace robosim {

/// A camera as it is mounted on robots of a model.
struct CameraView {
  CameraInfo info;
  mrpt::math::TPose3D robot_from_camera;  ///< x along the optical axis, z up
  int jpeg_quality = 85;                  ///< [1, 100]
};

/// Where cameras have their pictures from: whoever can draw the world. One source for all of a run's cameras.
class ImageSource {
 public:
  virtual ~ImageSource() = default;

  /// Takes a picture with the camera of each of `robots`, all at one moment. Several threads may call at once.
  /// @param world_from_robot where all robots of the world are, in its order
  /// @param jpegs one for each of `robots`, to be replaced by a JPEG file's bytes
  virtual void take(const CameraView& camera, std::span<const mrpt::math::TPose2D> world_from_robot,
                    std::span<const std::uint32_t> robots, std::span<std::string> jpegs) = 0;
};

}  // namespace robosim
