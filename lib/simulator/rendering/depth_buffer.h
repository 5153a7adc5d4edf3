#pragma once
#include <cstddef>
#include <vector>

namespace robosim {

/// Near plane and far plane of rendered pictures [m].
inline constexpr float kNearPlane_m = 0.02f, kFarPlane_m = 5000;

/// Converts a value of the depth buffer to metres along the optical axis; 0 at the far plane.
inline float metresAhead(float depth) {
  if (depth >= 1) return 0;
  constexpr double n = kNearPlane_m, f = kFarPlane_m;
  return static_cast<float>(n * f / (f - depth * (f - n)));
}

/// Depths of a rendered picture, converted where they are needed: a conversion of all pixels costs as much as a tenth
/// of the picture.
struct DepthBuffer {
  int width_px = 0, height_px = 0;
  std::vector<float> values{};  ///< as OpenGL returns them, row by row from the bottom

  bool empty() const { return values.empty(); }
  /// Depth along the optical axis [m], 0 for the sky; rows from the top.
  float metresAt(int x, int y) const {
    return metresAhead(values[static_cast<std::size_t>(height_px - 1 - y) * static_cast<std::size_t>(width_px) +
                              static_cast<std::size_t>(x)]);
  }
};

}  // namespace robosim
