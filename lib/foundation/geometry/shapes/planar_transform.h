#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose2D.h>

#include "base/portable_math.h"

namespace robosim {

/// Transform of a frame that is rotated about the vertical only, such as a robot's, with its sine and cosine computed
/// once.
class PlanarTransform {
 public:
  PlanarTransform() = default;
  /// @param z_m height of the frame's origin
  PlanarTransform(const mrpt::math::TPose2D& world_from_frame, double z_m)
      : PlanarTransform(world_from_frame, z_m, portable::sincos(world_from_frame.phi)) {}
  /// @param heading sine and cosine of world_from_frame.phi
  PlanarTransform(const mrpt::math::TPose2D& world_from_frame, double z_m, const portable::SinCos& heading)
      : x_(world_from_frame.x), y_(world_from_frame.y), z_(z_m), cos_(heading.cos), sin_(heading.sin) {}

  /// The same frame, rotated further about its own origin.
  PlanarTransform(const PlanarTransform& frame, double turn_rad) : PlanarTransform(frame) {
    if (turn_rad == 0) return;
    const auto [sin, cos] = portable::sincos(turn_rad);
    cos_ = frame.cos_ * cos - frame.sin_ * sin;
    sin_ = frame.sin_ * cos + frame.cos_ * sin;
  }

  double x() const { return x_; }
  double y() const { return y_; }
  double z() const { return z_; }
  double cos() const { return cos_; }
  double sin() const { return sin_; }

  mrpt::math::TPoint2D pointToWorld(const mrpt::math::TPoint2D& in_frame) const {
    return {x_ + cos_ * in_frame.x - sin_ * in_frame.y, y_ + sin_ * in_frame.x + cos_ * in_frame.y};
  }
  mrpt::math::TPoint3D pointToWorld(const mrpt::math::TPoint3D& in_frame) const {
    return {x_ + cos_ * in_frame.x - sin_ * in_frame.y, y_ + sin_ * in_frame.x + cos_ * in_frame.y, z_ + in_frame.z};
  }
  mrpt::math::TPoint2D turnToWorld(const mrpt::math::TPoint2D& v) const {
    return {cos_ * v.x - sin_ * v.y, sin_ * v.x + cos_ * v.y};
  }
  mrpt::math::TPoint3D turnToWorld(const mrpt::math::TPoint3D& v) const {
    return {cos_ * v.x - sin_ * v.y, sin_ * v.x + cos_ * v.y, v.z};
  }
  mrpt::math::TPoint3D turnToFrame(const mrpt::math::TPoint3D& v) const {
    return {cos_ * v.x + sin_ * v.y, cos_ * v.y - sin_ * v.x, v.z};
  }

 private:
  double x_ = 0, y_ = 0, z_ = 0, cos_ = 1, sin_ = 0;
};

}  // namespace robosim
