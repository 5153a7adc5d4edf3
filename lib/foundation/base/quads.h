#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace robosim {

/// Four numbers, of the compiler's vector types. Passed by reference: g++ warns about functions that take vectors.
///@{
using DoubleQuad [[gnu::vector_size(32)]] = double;
using Int64Quad [[gnu::vector_size(32)]] = std::int64_t;
using FloatQuad [[gnu::vector_size(16)]] = float;
using Int32Quad [[gnu::vector_size(16)]] = std::int32_t;
///@}

[[gnu::always_inline]] inline FloatQuad inEachLane(float number) { return FloatQuad{number, number, number, number}; }

/// Numbers that lie one after another.
///@{
[[gnu::always_inline]] inline void loadFour(const double* from, DoubleQuad& numbers) {
  std::memcpy(&numbers, from, sizeof numbers);
}
[[gnu::always_inline]] inline void storeFour(const DoubleQuad& numbers, double* to) {
  std::memcpy(to, &numbers, sizeof numbers);
}
///@}
/// Rounds to floats.
[[gnu::always_inline]] inline void storeFloats(const DoubleQuad& numbers, float* to) {
  const auto floats = __builtin_convertvector(numbers, FloatQuad);
  std::memcpy(to, &floats, sizeof floats);
}

/// One bit per lane: its sign bit.
///@{
[[gnu::always_inline]] inline std::uint32_t signsOf(const Int64Quad& lanes) {
#ifdef __SSE2__
  const auto* halves = reinterpret_cast<const __m128d*>(&lanes);
  return static_cast<std::uint32_t>(_mm_movemask_pd(halves[0]) | _mm_movemask_pd(halves[1]) << 2);
#else
  std::uint32_t signs = 0;
  for (std::size_t i = 0; i < 4; ++i) signs |= (lanes[i] < 0 ? 1U : 0U) << i;
  return signs;
#endif
}
[[gnu::always_inline]] inline std::uint32_t signsOf(const Int32Quad& lanes) {
#ifdef __SSE2__
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<const __m128&>(lanes)));
#else
  std::uint32_t signs = 0;
  for (std::size_t i = 0; i < 4; ++i) signs |= (lanes[i] < 0 ? 1U : 0U) << i;
  return signs;
#endif
}
///@}

}  // namespace robosim
