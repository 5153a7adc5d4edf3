#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/vector_clones.h"

namespace robosim {

/// Bits of a mask, one for each of the first `kMaskBits` of a loop: a sum of these becomes vector instructions where an
/// "or" of shifts would not.
constexpr std::size_t kMaskBits = 16;
constexpr auto kMaskBit = [] {
  std::array<std::uint32_t, kMaskBits> bits{};
  for (std::size_t i = 0; i < kMaskBits; ++i) bits[i] = std::uint32_t{1} << i;
  return bits;
}();

/// Doubles in the widest vector.
constexpr std::size_t kLanes = 8;
/// As many as whole vectors hold: what is over the count in the last one is worked out too, and not looked at.
constexpr std::size_t wholeVectors(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// Turns points about the origin and moves them by (x0, y0).
void transform(const double* __restrict x, const double* __restrict y, std::size_t count, double x0, double y0,
               double cos, double sin, double* __restrict to_x, double* __restrict to_y);

/// The largest of some numbers, at least four, a multiple of four.
inline double largest(const double* numbers, std::size_t count) {
  double most[4] = {numbers[0], numbers[1], numbers[2], numbers[3]};
  for (std::size_t i = 4; i < count; i += 4) {
    for (std::size_t j = 0; j < 4; ++j) most[j] = numbers[i + j] > most[j] ? numbers[i + j] : most[j];
  }
  return std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
}

}  // namespace robosim
