#pragma once
#include <algorithm>
#include <cmath>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>

#include "rendering/air_overlay.h"

namespace robosim {

/// A pinhole camera with square pixels, and the depths that it sees.
class AirView {
 public:
  /// What is nearer is not drawn [m].
  static constexpr double kNearest_m = 0.05;

  explicit AirView(const AirPicture& air)
      : air_(air),
        middle_((air.camera.width_px - 1) / 2.0, (air.camera.height_px - 1) / 2.0),
        focal_px_(air.camera.focalLength()),
        depth_finer_(std::max(1, air.depth.width_px / std::max(1, air.picture.cols))) {}

  /// In the camera's axes: x ahead, y left, z up.
  mrpt::math::TPoint3D seen(const mrpt::math::TPoint3D& world) const {
    mrpt::math::TPoint3D point;
    air_.world_from_camera.inverseComposePoint(world, point);
    return point;
  }
  /// (0, 0) is the middle of the upper left pixel.
  /// @pre seen.x > 0
  mrpt::math::TPoint2D pixel(const mrpt::math::TPoint3D& seen) const {
    return {middle_.x - focal_px_ * seen.y / seen.x, middle_.y - focal_px_ * seen.z / seen.x};
  }
  bool isOnPicture(const mrpt::math::TPoint2D& pixel) const {
    return pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x < air_.picture.cols - 0.5 && pixel.y < air_.picture.rows - 0.5;
  }
  /// Whether nothing nearer than `ahead_m` covers a pixel that isOnPicture().
  /// @param slack_m, slack_share by how much, also of the distance, something may be nearer
  bool isVisible(const mrpt::math::TPoint2D& pixel, double ahead_m, double slack_m, double slack_share = 0.01) const {
    const float depth_m =
        depthAt(static_cast<int>(std::floor(pixel.x + 0.5)), static_cast<int>(std::floor(pixel.y + 0.5)));
    return depth_m == 0 || ahead_m <= depth_m * (1 + slack_share) + slack_m;
  }
  /// [m]; 0 for the sky
  float depthAt(int x, int y) const { return air_.depth.metresAt(x * depth_finer_, y * depth_finer_); }
  double focalLength() const { return focal_px_; }
  const mrpt::math::TPoint2D& middle() const { return middle_; }

 private:
  const AirPicture& air_;
  mrpt::math::TPoint2D middle_;
  double focal_px_;
  int depth_finer_;  ///< pixels of the depth buffer per pixel
};

}  // namespace robosim
