#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/cell_pack.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace robosim {

/// A level ray in single precision, as seen from the middle of a grid that holds its origin.
struct RoughRay {
  float x, y, dx, dy;

  /// Marks the solids of a pack that the ray may meet nearer than its reach, by the disc about each, or by its
  /// rectangle where there are such: bit i for solid i. Of the compiler's own vector types, for g++ 12 makes no vector
  /// instructions of the loop; in a function with ROBOSIM_VECTOR_CLONES these are what each processor has. No sum waits
  /// for one that it does not need, for until the marks are there a processor may go on in vain.
  [[gnu::always_inline]] std::uint32_t passed(const CellPack& pack, const CellRectangles* rectangles,
                                              float reach_m) const {
    const auto& less_reach = reinterpret_cast<const Floats&>(pack.less_reach_m);
    const Floats ox = reinterpret_cast<const Floats&>(pack.x) - x;
    const Floats oy = reinterpret_cast<const Floats&>(pack.y) - y;
    const Floats along = dx * ox + dy * oy;
    Floats across = dx * oy - dy * ox;
    dropSign(across);
    // How much too far aside the solid is, or too far behind, or too far ahead: all are negative where it is passed.
    // Where there is no solid, nothing is, whatever the ray's numbers are: `across` lost its sign before anything was
    // added, so what is infinite or no number comes without one.
    Floats aside = across + less_reach;
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
    const Floats behind = less_reach - along;
    const Floats ahead = along + (less_reach - reach_m);
    const Bits signs = asBits(aside) & asBits(behind) & asBits(ahead);
    return signsOf(signs);
  }

 private:
  using Floats [[gnu::vector_size(sizeof(float) * CellPack::kMost), gnu::may_alias]] = float;
  using Bits [[gnu::vector_size(sizeof(float) * CellPack::kMost), gnu::may_alias]] = std::int32_t;

  // By reference, for g++ warns of functions that take or return vectors.
  [[gnu::always_inline]] static const Bits& asBits(const Floats& of) { return reinterpret_cast<const Bits&>(of); }
  [[gnu::always_inline]] static void dropSign(Floats& of) {
    reinterpret_cast<Bits&>(of) &= std::numeric_limits<std::int32_t>::max();
  }
  /// The sign of each number, in a bit.
  [[gnu::always_inline]] static std::uint32_t signsOf(const Bits& of) {
#ifdef __SSE__
    const auto* halves = reinterpret_cast<const __m128*>(&of);
    return static_cast<std::uint32_t>(_mm_movemask_ps(halves[0]) | _mm_movemask_ps(halves[1]) << 4);
#else
    std::uint32_t signs = 0;
    for (std::size_t i = 0; i < CellPack::kMost; ++i) signs |= static_cast<std::uint32_t>(of[i]) >> 31 << i;
    return signs;
#endif
  }
};

}  // namespace robosim
