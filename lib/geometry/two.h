#pragma once
#include <cstdint>

namespace robosim {

/// A pair of numbers, x and y say, that one instruction works on together: of the compiler's own vector types.
///@{
using Two [[gnu::vector_size(16)]] = double;
using TwoWhole [[gnu::vector_size(16)]] = std::int64_t;
///@}

/// The other way round.
[[gnu::always_inline]] inline Two swapped(const Two& of) { return __builtin_shufflevector(of, of, 1, 0); }
[[gnu::always_inline]] inline Two both(double number) { return Two{number, number}; }
/// The lesser and the greater, each lane for itself; `b` where there is no number.
///@{
[[gnu::always_inline]] inline Two least(const Two& a, const Two& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Two most(const Two& a, const Two& b) { return a > b ? a : b; }
///@}

}  // namespace robosim
