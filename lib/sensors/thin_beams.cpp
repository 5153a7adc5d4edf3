#include "sensors/thin_beams.h"

#include <algorithm>
#include <limits>

#include "base/vector_width.h"
#include "sensors/beam_mounts.h"
#include "sensors/planar_beams.h"

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Origins and directions of the beams, robot frame, before panning: structure of arrays, so that loops over beams are
/// vectorised.
struct BeamFields {
  std::vector<double> x, y, z, dx, dy, dz;

  void add(const Ray& beam) {
    x.push_back(beam.origin.x);
    y.push_back(beam.origin.y);
    z.push_back(beam.origin.z);
    dx.push_back(beam.direction.x);
    dy.push_back(beam.direction.y);
    dz.push_back(beam.direction.z);
  }
};

/// Computes the echo of each beam from its hit at `hit_m`. Branch-free, because whether a hit is in range is
/// unpredictable.
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

class ThinBeams : public Sensor {
 public:
  ThinBeams(const SensorInfo& info, const RangeNoise& noise)
      : info_(info), noise_(noise), beams_(info.beams), no_echoes_(beams_.size()) {
    for (std::size_t i = 0; i < beams_.size(); ++i) fields_.add(beams_[i]);
    setEchoes(PlanarTransform(), std::vector<double>(beams_.size(), kInfinity), no_echoes_);
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return noise_.on; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    static thread_local std::vector<double> hit_m;
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const double pan_rad = info_.pans ? now.laser_pan_rad[robot] : 0;
      hit_m.assign(beams_.size(), kInfinity);
      const bool any = beams_.cast(now, robot, pan_rad, info_.range_max_m,
                                   [&](std::size_t i, double distance_m, BodyId) { hit_m[i] = distance_m; });
      if (noise_.on) {
        addNoise(now.noise(robot, slot), hit_m);
      } else if (!any && pan_rad == 0) {
        std::copy(no_echoes_.begin(), no_echoes_.end(), echoes.begin());
        continue;
      }
      setEchoes(PlanarTransform(PlanarTransform(), pan_rad), hit_m, echoes);
    }
  }

 private:
  /// Every beam draws its own random numbers, independent of the other beams' hits.
  void addNoise(Rng rng, std::vector<double>& hit_m) const {
    for (auto& distance_m : hit_m) {
      distance_m = noise_.apply(distance_m < info_.range_max_m ? distance_m : kInfinity, rng);
    }
  }

  void setEchoes(const PlanarTransform& pan, const std::vector<double>& hit_m, Echoes& echoes) const {
    withVectors<computeEchoes>(&fields_, hit_m.size(), pan.cos(), pan.sin(), hit_m.data(),
                               static_cast<float>(info_.range_min_m), static_cast<float>(info_.range_max_m),
                               static_cast<float>(info_.no_echo_m), echoes.data());
  }

  SensorInfo info_;
  RangeNoise noise_;
  PlanarBeams beams_;
  BeamFields fields_;
  Echoes no_echoes_;  ///< of all beams without pan and without hits
};

}  // namespace

std::unique_ptr<Sensor> makeThinBeams(const SensorInfo& info, const RangeNoise& noise) {
  return std::make_unique<ThinBeams>(info, noise);
}

}  // namespace robosim
