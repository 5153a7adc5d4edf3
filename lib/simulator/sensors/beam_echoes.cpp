#include "sensors/beam_echoes.h"

#include "base/vector_width.h"

namespace robosim {
namespace {

/// Branch-free, because whether a hit is in range is unpredictable.
[[gnu::always_inline]] inline void computeEchoes(const BeamFields* beams, std::size_t count, double cos, double sin,
                                                 const double* __restrict hit_m, float range_min_m, float range_max_m,
                                                 float no_echo_m, Echo* __restrict echoes) {
  const double* __restrict x = beams->x.data();
  const double* __restrict y = beams->y.data();
  const double* __restrict z = beams->z.data();
  const double* __restrict dx = beams->dx.data();
  const double* __restrict dy = beams->dy.data();
  const double* __restrict dz = beams->dz.data();
  for (std::size_t i = 0; i < count; ++i) {
    const auto range_m = static_cast<float>(hit_m[i]);
    const bool is_echo = range_m < range_max_m;
    const float at_m = is_echo ? range_m : no_echo_m;
    const double out_m = at_m;
    echoes[i].range_m = (is_echo & (range_m < range_min_m)) ? range_min_m : at_m;
    echoes[i].point_m.x = static_cast<float>(x[i] + (cos * dx[i] - sin * dy[i]) * out_m);
    echoes[i].point_m.y = static_cast<float>(y[i] + (sin * dx[i] + cos * dy[i]) * out_m);
    echoes[i].point_m.z = static_cast<float>(z[i] + dz[i] * out_m);
  }
}

}  // namespace

void BeamFields::add(const Ray& beam) {
  x.push_back(beam.origin.x);
  y.push_back(beam.origin.y);
  z.push_back(beam.origin.z);
  dx.push_back(beam.direction.x);
  dy.push_back(beam.direction.y);
  dz.push_back(beam.direction.z);
}

void setEchoes(const BeamFields& beams, const SensorInfo& info, const PlanarTransform& pan,
               const std::vector<double>& hit_m, Echoes& echoes) {
  withVectors<computeEchoes>(&beams, hit_m.size(), pan.cos(), pan.sin(), hit_m.data(),
                             static_cast<float>(info.range_min_m), static_cast<float>(info.range_max_m),
                             static_cast<float>(info.no_echo_m), echoes.data());
}

}  // namespace robosim
