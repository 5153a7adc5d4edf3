#include "base/vector_width.h"

#include <stdexcept>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace robosim {
namespace {

CpuFeatures featuresOfThisProcessor() {
  CpuFeatures features;
#if defined(__x86_64__)
  const auto set = [&](CpuFeature feature, bool has) { features[static_cast<std::size_t>(feature)] = has; };
  __builtin_cpu_init();
  // Also tests whether the operating system saves the registers.
  set(CpuFeature::avx, __builtin_cpu_supports("avx") != 0);
  set(CpuFeature::avx2, __builtin_cpu_supports("avx2") != 0);
  set(CpuFeature::bmi, __builtin_cpu_supports("bmi") != 0);
  set(CpuFeature::bmi2, __builtin_cpu_supports("bmi2") != 0);
  set(CpuFeature::fma, __builtin_cpu_supports("fma") != 0);
  set(CpuFeature::avx512f, __builtin_cpu_supports("avx512f") != 0);
  set(CpuFeature::avx512bw, __builtin_cpu_supports("avx512bw") != 0);
  set(CpuFeature::avx512cd, __builtin_cpu_supports("avx512cd") != 0);
  set(CpuFeature::avx512dq, __builtin_cpu_supports("avx512dq") != 0);
  set(CpuFeature::avx512vl, __builtin_cpu_supports("avx512vl") != 0);
  // Not among the names of clang 14's __builtin_cpu_supports().
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(1, &a, &b, &c, &d) != 0) {
    set(CpuFeature::f16c, (c & bit_F16C) != 0);
    set(CpuFeature::movbe, (c & bit_MOVBE) != 0);
  }
  if (__get_cpuid(0x80000001, &a, &b, &c, &d) != 0) set(CpuFeature::lzcnt, (c & bit_LZCNT) != 0);
#endif
  return features;
}

}  // namespace

VectorWidth vector_width = widestVectors();

VectorWidth widestVectors(const CpuFeatures& features) {
  const auto has_all = [&](CpuFeature first, CpuFeature last) {
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      if (!features[i]) return false;
    }
    return true;
  };
  if (!has_all(CpuFeature::avx, CpuFeature::movbe)) return VectorWidth::sse2;
  return has_all(CpuFeature::avx512f, CpuFeature::avx512vl) ? VectorWidth::avx512 : VectorWidth::avx2;
}

VectorWidth widestVectors() { return widestVectors(featuresOfThisProcessor()); }

void setVectorWidth(VectorWidth width) {
  if (width > widestVectors()) throw std::invalid_argument("this processor has no vectors of that width");
  vector_width = width;
}

}  // namespace robosim
