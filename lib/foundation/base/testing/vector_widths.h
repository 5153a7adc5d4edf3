#pragma once
#include <string>

#include "base/vector_width.h"

namespace robosim {

inline std::string nameOf(VectorWidth width) {
  return width == VectorWidth::sse2 ? "sse2" : width == VectorWidth::avx2 ? "avx2" : "avx512";
}

/// Calls visit(width) with each vector width of this processor in use.
template <typename Visit>
void forEachVectorWidth(const Visit& visit) {
  for (const auto width : {VectorWidth::sse2, VectorWidth::avx2, VectorWidth::avx512}) {
    if (width > widestVectors()) continue;
    setVectorWidth(width);
    visit(width);
  }
  setVectorWidth(widestVectors());
}

}  // namespace robosim
