#pragma once
#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose3D.h>

#include "hardware/sensor_info.h"

namespace robosim {

/// Axes of a camera as unit vectors in the robot's frame.
struct CameraAxes {
  mrpt::math::TPoint3D ahead, left, up;

  static CameraAxes of(const mrpt::math::TPose3D& robot_from_camera);
};

/// Directions of the rays through the centres of a camera's pixels.
class PixelRays {
 public:
  explicit PixelRays(const CameraInfo& info) : info_(info), per_px_(1 / info.focalLength()) {}

  double focalLength() const { return info_.focalLength(); }
  /// Offset from the optical axis at a depth of 1 m, without distortion by the lens.
  ///@{
  double left(double column) const { return (info_.width_px / 2.0 - (column + 0.5)) * per_px_; }
  double up(double row) const { return (info_.height_px / 2.0 - (row + 0.5)) * per_px_; }
  ///@}
  /// The same of a pixel, with distortion: (left, up).
  struct Offset {
    double left = 0, up = 0;
  };
  Offset of(std::uint32_t column, std::uint32_t row) const;

 private:
  CameraInfo info_;
  double per_px_;
};

}  // namespace robosim
