#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "geometry/index/culling.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace robosim {

/// Solids of a grid cell, as the discs that cover them: structure of arrays in single precision, so that one vector
/// instruction tests all of them and the arrays fill two cache lines. Unused entries never match. A cell with more than
/// kCapacity solids links to a further pack: the last index then holds that pack's number.
struct alignas(64) CellPack {
  static constexpr std::size_t kCapacity = 8;

  float x[kCapacity], y[kCapacity], negative_reach_m[kCapacity];
  std::uint32_t index[kCapacity];  ///< index into GridIndex::items(); kNoSolid for an unused entry

  CellPack() {
    for (auto* field : {x, y}) std::fill_n(field, kCapacity, 0.0F);
    std::fill_n(negative_reach_m, kCapacity, std::numeric_limits<float>::max());  // never matches
    std::fill_n(index, kCapacity, kNoSolid);
  }

  void set(std::size_t i, const CullDisc& solid, double reach_m, std::uint32_t solid_index) {
    x[i] = solid.x;
    y[i] = solid.y;
    negative_reach_m[i] = static_cast<float>(-reach_m);
    index[i] = solid_index;
  }
  /// Number of packs that hold `solids` solids of a cell. Every pack but the last holds one solid less than kCapacity.
  static constexpr std::size_t packCount(std::size_t solids) {
    return solids <= kCapacity ? 1 : 1 + (solids - kCapacity + kSolidsBeforeLink - 1) / kSolidsBeforeLink;
  }
  static constexpr std::size_t kSolidsBeforeLink = kCapacity - 1;
  void linkTo(std::uint32_t pack) { index[kCapacity - 1] = kLink | pack; }
  bool hasNext() const { return index[kCapacity - 1] >= kLink; }
  /// Number of the cell's next pack.
  std::uint32_t next() const { return index[kCapacity - 1] & ~kLink; }

  template <typename Visit>
  void visit(const Visit& visit) const {
    for (std::size_t i = 0; i < kCapacity && index[i] < kNoSolid; ++i) visit(index[i]);
  }

  /// Calls visit(index) for the solids that may lie within `reach_m` of a point, which is relative to the middle of the
  /// grid and inside the grid. Conservative: no false negatives.
  template <typename Visit>
  void visitNear(float at_x, float at_y, float reach_m, const Visit& visit) const {
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < kCapacity; i += 4) {
      const auto four = [i](const float* field, FloatQuad& numbers) __attribute__((always_inline)) {
        std::memcpy(&numbers, field + i, sizeof numbers);
      };
      FloatQuad dx, dy, negative_reach;
      four(x, dx);
      four(y, dy);
      four(negative_reach_m, negative_reach);
      dx -= at_x;
      dy -= at_y;
      const FloatQuad far_m = reach_m - negative_reach;
      // The radius is negative for unused entries, whose square may be infinite.
      found |= signsOf((dx * dx + dy * dy <= far_m * far_m) & (far_m >= 0)) << i;
    }
    for (; found != 0; found &= found - 1) visit(index[std::countr_zero(found)]);
  }

 private:
  static constexpr std::uint32_t kNoSolid = 0x7fffffff;
  static constexpr std::uint32_t kLink = 0x80000000;
};

/// The same solids as the rectangles that cover them. A circle becomes a square of arbitrary orientation.
struct alignas(64) CellRectangles {
  float axis_x[CellPack::kCapacity]{}, axis_y[CellPack::kCapacity]{};  ///< unit vector along the length
  float half_length_m[CellPack::kCapacity]{}, half_width_m[CellPack::kCapacity]{};

  /// @param margin_m added to the solid's extent on every side
  void set(std::size_t i, const GridItem& item, double margin_m) {
    axis_x[i] = static_cast<float>(item.axis_x);
    axis_y[i] = static_cast<float>(item.axis_y);
    half_length_m[i] = static_cast<float>(item.half_length_m + margin_m);
    half_width_m[i] = static_cast<float>((item.isCircle() ? item.half_length_m : item.half_width_m) + margin_m);
  }
};

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
