#include "sensors/thin_beams.h"

#include <algorithm>
#include <limits>

#include "geometry/vector_clones.h"
#include "sensors/beam_mounts.h"
#include "sensors/level_beams.h"

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Where beams start and look, robot frame, before panning; by field, so that a loop over beams becomes vector
/// instructions.
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

/// The echo of every beam that met something at `met_m`. Whether that is in range is anybody's guess, so nothing here
/// branches on it.
ROBOSIM_VECTOR_CLONES
void tellAll(const BeamFields& beams, std::size_t count, const LevelFrame& pan, const double* __restrict met_m,
             float range_min_m, float range_max_m, float no_echo_m, Echo* __restrict echoes) {
  const double* __restrict x = beams.x.data();
  const double* __restrict y = beams.y.data();
  const double* __restrict z = beams.z.data();
  const double* __restrict dx = beams.dx.data();
  const double* __restrict dy = beams.dy.data();
  const double* __restrict dz = beams.dz.data();
  const double cos = pan.cos();
  const double sin = pan.sin();
  for (std::size_t i = 0; i < count; ++i) {
    const auto range_m = static_cast<float>(met_m[i]);
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
      : info_(info), noise_(noise), beams_(info.beams), silence_(beams_.size()) {
    for (std::size_t i = 0; i < beams_.size(); ++i) fields_.add(beams_[i]);
    tell(LevelFrame(), std::vector<double>(beams_.size(), kInfinity), silence_);
  }

  const SensorInfo& info() const override { return info_; }
  Measurement blank() const override { return Echoes(beams_.size()); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    static thread_local std::vector<double> met_m;
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const double pan_rad = info_.pans ? now.laser_pan_rad[robot] : 0;
      met_m.assign(beams_.size(), kInfinity);
      const bool any = beams_.cast(now, robot, pan_rad, info_.range_max_m,
                                   [&](std::size_t i, double distance_m, BodyId) { met_m[i] = distance_m; });
      if (noise_.on) {
        addNoise(now.noise(robot, slot), met_m);
      } else if (!any && pan_rad == 0) {
        std::copy(silence_.begin(), silence_.end(), echoes.begin());
        continue;
      }
      tell(LevelFrame(LevelFrame(), pan_rad), met_m, echoes);
    }
  }

 private:
  /// Every beam draws its own numbers, whatever the others meet.
  void addNoise(Rng rng, std::vector<double>& met_m) const {
    for (auto& distance_m : met_m) {
      distance_m = noise_.apply(distance_m < info_.range_max_m ? distance_m : kInfinity, rng);
    }
  }

  void tell(const LevelFrame& pan, const std::vector<double>& met_m, Echoes& echoes) const {
    tellAll(fields_, met_m.size(), pan, met_m.data(), static_cast<float>(info_.range_min_m),
            static_cast<float>(info_.range_max_m), static_cast<float>(info_.no_echo_m), echoes.data());
  }

  SensorInfo info_;
  RangeNoise noise_;
  LevelBeams beams_;
  BeamFields fields_;
  Echoes silence_;  ///< of all beams, not panned, where nothing is in range
};

}  // namespace

std::unique_ptr<Sensor> makeThinBeams(const SensorInfo& info, const RangeNoise& noise) {
  return std::make_unique<ThinBeams>(info, noise);
}

}  // namespace robosim
