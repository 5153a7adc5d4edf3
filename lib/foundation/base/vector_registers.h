#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace robosim {

/// ISA-L returns with non-zero upper halves of the vector registers, which slow down SSE instructions until they are
/// cleared: a simulation that recorded in its own thread ran at half its speed. Call this after a call of ISA-L.
#if defined(__x86_64__)
__attribute__((target("avx"))) inline void clearUpperHalves() { _mm256_zeroupper(); }

inline void clearVectorRegisters() {
  if (__builtin_cpu_supports("avx")) clearUpperHalves();
}
#else
inline void clearVectorRegisters() {}
#endif

}  // namespace robosim
