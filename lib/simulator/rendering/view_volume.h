#pragma once
#include <array>

#include <mrpt/math/TPoint3D.h>
#include <mrpt/opengl/TRenderMatrices.h>

namespace robosim {

/// View frustum of a camera, for culling.
class ViewVolume {
 public:
  explicit ViewVolume(const mrpt::opengl::TRenderMatrices& matrices);

  /// Whether a sphere may intersect the frustum; conservative: no false negatives.
  bool mayIntersect(const mrpt::math::TPoint3Df& center, float radius_m) const;
  /// Approximate radius of a sphere on the picture [pixels].
  float radiusPx(const mrpt::math::TPoint3Df& center, float radius_m) const;

 private:
  struct Plane {
    float x = 0, y = 0, z = 0, w = 0;  ///< unit normal, pointing inwards
    float of(const mrpt::math::TPoint3Df& p) const { return x * p.x + y * p.y + z * p.z + w; }
  };
  std::array<Plane, 5> sides_;  ///< left, right, bottom, top, near
  Plane depth_;                 ///< perspective divisor; normal not of unit length
  float px_per_radian_ = 1;
};

}  // namespace robosim
