#include "geometry/ray_pairs.h"

#include "geometry/level_ray.h"
#include "geometry/vector_clones.h"

namespace robosim {
namespace {

/// As many as a vector holds: what is over the count in the last one is worked out too, and not looked at.
constexpr std::size_t kLanes = 8;

std::size_t wholeVectors(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

ROBOSIM_VECTOR_CLONES
void enterAll(std::size_t count, const double* __restrict ox, const double* __restrict oy, const double* __restrict dx,
              const double* __restrict dy, const double* __restrict radius, double* __restrict entered) {
  for (std::size_t k = 0; k < count; ++k) entered[k] = enterCircle(ox[k], oy[k], dx[k], dy[k], radius[k]);
}

ROBOSIM_VECTOR_CLONES
void enterAll(std::size_t count, const double* __restrict ox, const double* __restrict oy, const double* __restrict dx,
              const double* __restrict dy, const double* __restrict ux, const double* __restrict uy,
              const double* __restrict half_length, const double* __restrict half_width, double* __restrict entered) {
  for (std::size_t k = 0; k < count; ++k) {
    entered[k] = enterBox(ox[k], oy[k], dx[k], dy[k], ux[k], uy[k], half_length[k], half_width[k]);
  }
}

}  // namespace

void RayPairs::enterCircles(Pairs& p) {
  enterAll(wholeVectors(p.count), p.ox.data(), p.oy.data(), p.dx.data(), p.dy.data(), p.a.data(), p.entered.data());
}

void RayPairs::enterBoxes(Pairs& p) {
  enterAll(wholeVectors(p.count), p.ox.data(), p.oy.data(), p.dx.data(), p.dy.data(), p.ux.data(), p.uy.data(),
           p.a.data(), p.b.data(), p.entered.data());
}

}  // namespace robosim
