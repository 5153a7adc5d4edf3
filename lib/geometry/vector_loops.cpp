#include "geometry/vector_loops.h"

namespace robosim {

ROBOSIM_VECTOR_CLONES
void transform(const double* __restrict x, const double* __restrict y, std::size_t count, double x0, double y0,
               double cos, double sin, double* __restrict to_x, double* __restrict to_y) {
  for (std::size_t i = 0; i < count; ++i) {
    to_x[i] = x0 + cos * x[i] - sin * y[i];
    to_y[i] = y0 + sin * x[i] + cos * y[i];
  }
}

}  // namespace robosim
