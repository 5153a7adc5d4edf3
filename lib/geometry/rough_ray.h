#pragma once
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

/// Bit i for solid i of a pack.
inline constexpr PackMarks kPackBits = {1, 2, 4, 8, 16, 32, 64, 128};

/// Adds to `marks` the bits of the solids that lie on a ray's way nearer than its reach, by the rectangle about each
/// that lies along and across the ray.
[[gnu::always_inline]] inline void markPassed(const RoughRay& ray, const GridIndex::Pack& pack, float reach_m,
                                              const PackMarks& bits, PackMarks& marks) {
  const auto& x = reinterpret_cast<const PackFloats&>(pack.x);
  const auto& y = reinterpret_cast<const PackFloats&>(pack.y);
  const auto& axis_x = reinterpret_cast<const PackFloats&>(pack.axis_x);
  const auto& axis_y = reinterpret_cast<const PackFloats&>(pack.axis_y);
  const auto& half_length = reinterpret_cast<const PackFloats&>(pack.half_length_m);
  const auto& half_width = reinterpret_cast<const PackFloats&>(pack.half_width_m);
  const auto& round_m = reinterpret_cast<const PackFloats&>(pack.round_m);
  constexpr std::int32_t kAllButTheSign = 0x7fffffff;
  const PackFloats ox = x - ray.x;
  const PackFloats oy = y - ray.y;
  const PackFloats round = round_m + ray.lost_m;
  const PackFloats along = ray.dx * ox + ray.dy * oy;
  const PackFloats across = ray.dx * oy - ray.dy * ox;
  const PackFloats along_a = ray.dx * axis_x + ray.dy * axis_y;
  const PackFloats along_b = ray.dy * axis_x - ray.dx * axis_y;
  const auto slope_a = reinterpret_cast<PackFloats>(reinterpret_cast<PackMarks>(along_a) & kAllButTheSign);
  const auto slope_b = reinterpret_cast<PackFloats>(reinterpret_cast<PackMarks>(along_b) & kAllButTheSign);
  const PackFloats wide = half_length * slope_b + (half_width * slope_a + round);
  const PackFloats deep = half_length * slope_a + (half_width * slope_b + round);
  marks |= ((across <= wide) & (-across <= wide) & (along >= -deep) & (along - deep <= reach_m)) & bits;
}

/// All the marks in one number.
[[gnu::always_inline]] inline std::uint32_t together(const PackMarks& marks) {
  std::uint32_t all = 0;
  for (std::size_t i = 0; i < GridIndex::Pack::kMost; ++i) all |= static_cast<std::uint32_t>(marks[i]);
  return all;
}

}  // namespace robosim
