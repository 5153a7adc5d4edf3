#pragma once
#include <cstdint>

#include <mrpt/math/TPoint2D.h>

namespace robosim {

/// Vectors of two lanes, such as x and y, of the compiler's vector types.
///@{
using DoublePair [[gnu::vector_size(16)]] = double;
using Int64Pair [[gnu::vector_size(16)]] = std::int64_t;
///@}

/// The lanes exchanged.
[[gnu::always_inline]] inline DoublePair swapped(const DoublePair& of) { return __builtin_shufflevector(of, of, 1, 0); }
[[gnu::always_inline]] inline DoublePair broadcast(double number) { return DoublePair{number, number}; }
/// Lane-wise minimum and maximum; `b` when the comparison involves NaN.
///@{
[[gnu::always_inline]] inline DoublePair min(const DoublePair& a, const DoublePair& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline DoublePair max(const DoublePair& a, const DoublePair& b) { return a > b ? a : b; }
///@}

[[gnu::always_inline]] inline DoublePair pairOf(const mrpt::math::TPoint2D& p) { return DoublePair{p.x, p.y}; }

}  // namespace robosim
