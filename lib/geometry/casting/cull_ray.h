#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/index/cell_pack.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace robosim {

/// Planar ray in single precision for conservative culling, relative to the middle of a grid that contains its origin.
struct CullRay {
  float x, y, dx, dy;

  /// Mask of the pack's solids that the ray may intersect nearer than `reach_m`: bit i for solid i. Tests each solid's
  /// covering disc, or its rectangle where `rectangles` is given. Conservative: no false negatives. Uses the compiler's
  /// vector types because g++ 12 does not vectorise the loop; in a function of withVectors() they compile to
  /// each processor's own width. No operation depends on a result that it does not need, which shortens the critical
  /// path before the branch on the mask.
  [[gnu::always_inline]] std::uint32_t mayHit(const CellPack& pack, const CellRectangles* rectangles,
                                              float reach_m) const {
    const auto& negative_reach = reinterpret_cast<const Floats&>(pack.negative_reach_m);
    const Floats ox = reinterpret_cast<const Floats&>(pack.x) - x;
    const Floats oy = reinterpret_cast<const Floats&>(pack.y) - y;
    const Floats along = dx * ox + dy * oy;
    Floats across = dx * oy - dy * ox;
    dropSign(across);
    // Signed distances to the limits: lateral, behind, ahead. All are negative for a solid that may be hit. Unused
    // entries never match, whatever the ray's values: `across` lost its sign before anything was added, so infinity or
    // NaN has a clear sign bit.
    Floats aside = across + negative_reach;
    if (rectangles != nullptr) {
      const auto& axis_x = reinterpret_cast<const Floats&>(rectangles->axis_x);
      const auto& axis_y = reinterpret_cast<const Floats&>(rectangles->axis_y);
      Floats slope_a = dx * axis_x + dy * axis_y;
      Floats slope_b = dy * axis_x - dx * axis_y;
      dropSign(slope_a);
      dropSign(slope_b);
      aside = across - (reinterpret_cast<const Floats&>(rectangles->half_length_m) * slope_b +
                        reinterpret_cast<const Floats&>(rectangles->half_width_m) * slope_a);
    }
    const Floats behind = negative_reach - along;
    const Floats ahead = along + (negative_reach - reach_m);
    const Bits signs = asBits(aside) & asBits(behind) & asBits(ahead);
    return signsOf(signs);
  }

 private:
  using Floats [[gnu::vector_size(sizeof(float) * CellPack::kCapacity), gnu::may_alias]] = float;
  using Bits [[gnu::vector_size(sizeof(float) * CellPack::kCapacity), gnu::may_alias]] = std::int32_t;

  // Passed by reference: g++ warns about functions that take or return vectors.
  [[gnu::always_inline]] static const Bits& asBits(const Floats& of) { return reinterpret_cast<const Bits&>(of); }
  [[gnu::always_inline]] static void dropSign(Floats& of) {
    reinterpret_cast<Bits&>(of) &= std::numeric_limits<std::int32_t>::max();
  }
  /// One bit per lane: its sign bit.
  [[gnu::always_inline]] static std::uint32_t signsOf(const Bits& of) {
#ifdef __SSE__
    const auto* halves = reinterpret_cast<const __m128*>(&of);
    return static_cast<std::uint32_t>(_mm_movemask_ps(halves[0]) | _mm_movemask_ps(halves[1]) << 4);
#else
    std::uint32_t signs = 0;
    for (std::size_t i = 0; i < CellPack::kCapacity; ++i) signs |= static_cast<std::uint32_t>(of[i]) >> 31 << i;
    return signs;
#endif
  }
};

}  // namespace robosim
