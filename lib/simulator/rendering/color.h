#pragma once
#include <array>
#include <cstddef>

namespace robosim {

/// Red, green, blue, each in [0, 1].
using Color = std::array<float, 3>;

inline Color mix(const Color& a, const Color& b, float share_of_b) {
  Color mixed;
  for (std::size_t i = 0; i < 3; ++i) mixed[i] = a[i] + (b[i] - a[i]) * share_of_b;
  return mixed;
}

}  // namespace robosim
