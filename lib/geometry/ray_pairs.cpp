#include "geometry/ray_pairs.h"

#include "geometry/level_ray.h"
#include "geometry/vector_loops.h"

namespace robosim {
namespace {

/// Both ways for each pair, for a box and for a circle: two half-filled vectors would cost as much, and sorting the
/// pairs more.
ROBOSIM_VECTOR_CLONES
void enter(std::size_t count, const double* __restrict ox, const double* __restrict oy, const double* __restrict dx,
           const double* __restrict dy, const double* __restrict axis_x, const double* __restrict axis_y,
           const double* __restrict half_length, const double* __restrict half_width, const double* __restrict round,
           double* __restrict entered) {
  for (std::size_t k = 0; k < count; ++k) {
    const double circle = enterCircle(ox[k], oy[k], dx[k], dy[k], round[k]);
    const double box = enterBox(ox[k], oy[k], dx[k], dy[k], axis_x[k], axis_y[k], half_length[k], half_width[k]);
    entered[k] = round[k] > 0 ? circle : box;
  }
}

}  // namespace

void RayPairs::enterAll() {
  enter(wholeVectors(count_), ox_.data(), oy_.data(), dx_.data(), dy_.data(), axis_x_.data(), axis_y_.data(),
        half_length_.data(), half_width_.data(), round_.data(), entered_.data());
}

}  // namespace robosim
