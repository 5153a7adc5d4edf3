#include "geometry/vector_width.h"

#include <stdexcept>

namespace robosim {

VectorWidth vector_width = widestVectors();

VectorWidth widestVectors() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  // Every processor with these features has all of x86-64-v3 or v4, names that clang 14 does not accept here.
  const bool has_avx2 =
      __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi2") != 0 && __builtin_cpu_supports("fma") != 0;
  const bool has_avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                          __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                          __builtin_cpu_supports("avx512vl") != 0;
  if (has_avx2 && has_avx512) return VectorWidth::avx512;
  if (has_avx2) return VectorWidth::avx2;
#endif
  return VectorWidth::sse2;
}

void setVectorWidth(VectorWidth width) {
  if (width > widestVectors()) throw std::invalid_argument("this processor has no vectors of that width");
  vector_width = width;
}

}  // namespace robosim
