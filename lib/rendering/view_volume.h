#pragma once
#include <array>

#include <mrpt/math/TPoint3D.h>
#include <mrpt/opengl/TRenderMatrices.h>

namespace robosim {

/// What a camera sees, for leaving out what it does not.
class ViewVolume {
 public:
  explicit ViewVolume(const mrpt::opengl::TRenderMatrices& matrices);

  /// Whether any of a ball may be in the picture.
  bool mayHold(const mrpt::math::TPoint3Df& center, float radius_m) const;
  /// How large a ball in the picture is [pixels]: its radius, about.
  float radiusPx(const mrpt::math::TPoint3Df& center, float radius_m) const;

 private:
  struct Plane {
    float x = 0, y = 0, z = 0, w = 0;  ///< of unit normal, which points inside
    float of(const mrpt::math::TPoint3Df& p) const { return x * p.x + y * p.y + z * p.z + w; }
  };
  std::array<Plane, 5> sides_;  ///< left, right, bottom, top, near
  Plane depth_;                 ///< what a place is divided by in perspective; not of unit length
  float px_per_radian_ = 1;
};

}  // namespace robosim
