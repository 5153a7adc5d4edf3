#include "sensors/thin_beams.h"

#include <algorithm>
#include <limits>

#include "sensors/beam_echoes.h"
#include "sensors/planar_beams.h"

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class ThinBeams : public Sensor {
 public:
  ThinBeams(const SensorInfo& info, const RangeNoise& noise)
      : info_(info), noise_(noise), beams_(info.beams), no_echoes_(beams_.size()) {
    for (std::size_t i = 0; i < beams_.size(); ++i) fields_.add(beams_[i]);
    setEchoes(fields_, info_, PlanarTransform(), std::vector<double>(beams_.size(), kInfinity), no_echoes_);
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return noise_.on; }
  double robotReach(double) const override { return beamReach(info_); }

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
      setEchoes(fields_, info_, PlanarTransform(PlanarTransform(), pan_rad), hit_m, echoes);
    }
  }

 private:
  /// Every beam draws its own random numbers, independent of the other beams' hits.
  void addNoise(Rng rng, std::vector<double>& hit_m) const {
    for (auto& distance_m : hit_m) {
      distance_m = noise_.apply(distance_m < info_.range_max_m ? distance_m : kInfinity, rng);
    }
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
