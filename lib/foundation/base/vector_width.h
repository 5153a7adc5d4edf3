#pragma once
#include <bitset>
#include <cstddef>
#include <cstdint>

/// Selection of code by the width of the processor's vectors. All variants perform the same operations on the same
/// numbers (-ffp-contract=off), so the results are bit-identical.
namespace robosim {

/// Instruction sets for which loops are compiled. Platforms other than x86-64 have `sse2` only, compiled for their own
/// vectors.
enum class VectorWidth : std::uint8_t {
  sse2,    ///< 128 bits: every x86-64
  avx2,    ///< 256 bits: x86-64-v3
  avx512,  ///< 512 bits: x86-64-v4
};

/// Extensions of the instruction set: those of x86-64-v3, up to movbe, then those of x86-64-v4 (x86-64 psABI 1.0,
/// section 3.1.1).
enum class CpuFeature : std::uint8_t {
  avx,
  avx2,
  bmi,
  bmi2,
  f16c,
  fma,
  lzcnt,
  movbe,
  avx512f,
  avx512bw,
  avx512cd,
  avx512dq,
  avx512vl,
};
using CpuFeatures = std::bitset<static_cast<std::size_t>(CpuFeature::avx512vl) + 1>;  ///< by CpuFeature

/// The widest vectors of a processor with these features: code for a width may use all features of its level.
VectorWidth widestVectors(const CpuFeatures& features);
/// The widest that this processor, and its operating system, supports.
VectorWidth widestVectors();

/// The width in use: the widest, unless setVectorWidth() was called.
extern VectorWidth vector_width;
/// For tests and measurements. Must not be called while other threads cast rays.
/// @throws std::invalid_argument if the processor does not support the width
void setVectorWidth(VectorWidth width);

/// @name The variants of withVectors()
///@{
#if defined(__x86_64__)
template <auto kFunction, typename... Arguments>
[[gnu::target("arch=x86-64-v4")]] auto callAvx512(Arguments... arguments) {
  return kFunction(arguments...);
}
template <auto kFunction, typename... Arguments>
[[gnu::target("arch=x86-64-v3")]] auto callAvx2(Arguments... arguments) {
  return kFunction(arguments...);
}
#endif
// Not inlined, because the caller would reserve the registers and the stack of this variant for all of them.
template <auto kFunction, typename... Arguments>
[[gnu::noinline]] auto callBaseline(Arguments... arguments) {
  return kFunction(arguments...);
}
///@}

/// Calls a function compiled for the vector width in use. The function, and all that it calls in loops, must be
/// [[gnu::always_inline]]. Its arguments are passed by value.
template <auto kFunction, typename... Arguments>
auto withVectors(Arguments... arguments) {
#if defined(__x86_64__)
  if (vector_width == VectorWidth::avx512) return callAvx512<kFunction>(arguments...);
  if (vector_width == VectorWidth::avx2) return callAvx2<kFunction>(arguments...);
#endif
  return callBaseline<kFunction>(arguments...);
}

}  // namespace robosim
