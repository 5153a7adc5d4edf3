#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/grid_index.h"

namespace robosim {

/// A level ray in single precision, as seen from the middle of the scene.
struct RoughRay {
  float x, y, lost_m, dx, dy;
};

/// A number for each solid of a pack. Of the compiler's own vector types, for no loop of GCC 12 that marks several
/// packs becomes vector instructions; in a function with ROBOSIM_VECTOR_CLONES these are what each processor has.
///@{
using PackFloats [[gnu::vector_size(sizeof(float) * GridIndex::Pack::kMost), gnu::may_alias]] = float;
using PackMarks [[gnu::vector_size(sizeof(float) * GridIndex::Pack::kMost)]] = std::int32_t;
///@}

/// Finds which solids of a pack lie on a ray's way nearer than its reach, by the rectangle about each that lies along
/// and across the ray.
/// @param passed -1 for those, 0 for others (no result, for g++ warns of a function that returns vectors)
[[gnu::always_inline]] inline void lookAt(const RoughRay& ray, const GridIndex::Pack& pack, float reach_m,
                                          PackMarks& passed) {
  const auto& x = reinterpret_cast<const PackFloats&>(pack.x);
  const auto& y = reinterpret_cast<const PackFloats&>(pack.y);
  const auto& axis_x = reinterpret_cast<const PackFloats&>(pack.axis_x);
  const auto& axis_y = reinterpret_cast<const PackFloats&>(pack.axis_y);
  const auto& half_length = reinterpret_cast<const PackFloats&>(pack.half_length_m);
  const auto& half_width = reinterpret_cast<const PackFloats&>(pack.half_width_m);
  const auto& round_m = reinterpret_cast<const PackFloats&>(pack.round_m);
  const auto drop_sign = [](PackFloats & of) __attribute__((always_inline)) {
    constexpr std::int32_t kAllButTheSign = 0x7fffffff;
    of = reinterpret_cast<PackFloats>(reinterpret_cast<PackMarks&>(of) & kAllButTheSign);
  };
  const PackFloats ox = x - ray.x;
  const PackFloats oy = y - ray.y;
  const PackFloats round = round_m + ray.lost_m;
  const PackFloats along = ray.dx * ox + ray.dy * oy;
  PackFloats across = ray.dx * oy - ray.dy * ox;
  PackFloats slope_a = ray.dx * axis_x + ray.dy * axis_y;
  PackFloats slope_b = ray.dy * axis_x - ray.dx * axis_y;
  for (auto* value : {&across, &slope_a, &slope_b}) drop_sign(*value);
  const PackFloats wide = half_length * slope_b + (half_width * slope_a + round);
  const PackFloats deep = half_length * slope_a + (half_width * slope_b + round);
  // How far the solid's middle lies behind the origin or beyond the reach; `deep`, for which a processor waits longest,
  // comes in last.
  const PackFloats beyond = along - reach_m;
  const PackFloats off = beyond > -along ? beyond : -along;
  passed = (across <= wide) & (off <= deep);
}

/// Marks in one number, a byte each: bit 8 i for solid i.
[[gnu::always_inline]] inline std::uint64_t inBytes(const PackMarks& marks) {
  using Bytes [[gnu::vector_size(GridIndex::Pack::kMost)]] = std::int8_t;
  return std::bit_cast<std::uint64_t>(__builtin_convertvector(marks, Bytes)) & 0x0101010101010101U;
}

/// All of some marks in one number.
[[gnu::always_inline]] inline std::uint32_t together(const PackMarks& marks) {
  PackMarks all = marks | __builtin_shufflevector(marks, marks, 4, 5, 6, 7, 4, 5, 6, 7);
  all |= __builtin_shufflevector(all, all, 2, 3, 2, 3, 2, 3, 2, 3);
  all |= __builtin_shufflevector(all, all, 1, 1, 1, 1, 1, 1, 1, 1);
  return static_cast<std::uint32_t>(all[0]);
}

}  // namespace robosim
