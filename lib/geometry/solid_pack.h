#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/rough_solid.h"

namespace robosim {

/// Some solids by field, in single precision, so that one vector instruction looks at many of them. Where there are
/// fewer than Most, the others are nowhere.
template <std::size_t Most>
struct alignas(32) SolidPack {
  static constexpr std::size_t kMost = Most;

  float x[Most], y[Most], axis_x[Most], axis_y[Most], half_length_m[Most], half_width_m[Most], round_m[Most];
  std::uint32_t index[Most];  ///< in the order of the index
  std::uint32_t count = 0;

  SolidPack() {
    for (auto* field : {x, y, axis_x, axis_y, half_length_m, half_width_m}) std::fill_n(field, Most, 0.0F);
    std::fill_n(round_m, Most, -std::numeric_limits<float>::max());  // nothing passes so near
    std::fill_n(index, Most, 0U);
  }
  void add(const RoughSolid& solid, std::uint32_t solid_index) { addIf(true, solid, solid_index); }
  /// Without a branch.
  void addIf(bool wanted, const RoughSolid& solid, std::uint32_t solid_index) {
    x[count] = solid.x;
    y[count] = solid.y;
    axis_x[count] = solid.axis_x;
    axis_y[count] = solid.axis_y;
    half_length_m[count] = solid.half_length_m;
    half_width_m[count] = solid.half_width_m;
    round_m[count] = solid.round_m;
    index[count] = solid_index;
    count += wanted ? 1 : 0;
  }
  bool isFull() const { return count == Most; }
};

}  // namespace robosim
