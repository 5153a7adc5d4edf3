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
    for (const auto& group : beams_.groups()) {
      BeamFields& fields = fields_of_group_.emplace_back();
      for (const auto beam : group.beam_of_slot) fields.add(beams_[beam]);
    }
    setEchoes(fields_, EchoRule(info_), std::vector<double>(beams_.size(), kInfinity), no_echoes_);
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return noise_.on; }
  double robotReach(double) const override { return beamReach(info_); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    static thread_local BeamBatch reused;
    BeamBatch& batch = reused;  // found once: a thread's variable is found by a call
    const EchoRule unpanned(info_);
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const double pan_rad = info_.pans ? now.laser_pan_rad[robot] : 0;
      if (noise_.on) {
        senseWithNoise(now, robot, slot, pan_rad, echoes);
      } else if (pan_rad == 0) {
        senseExactly(now, robot, pan_rad, unpanned, batch, echoes);
      } else {
        senseExactly(now, robot, pan_rad, EchoRule(info_, PlanarTransform(PlanarTransform(), pan_rad)), batch, echoes);
      }
    }
  }

 private:
  void senseExactly(const Snapshot& now, std::uint32_t robot, double pan_rad, const EchoRule& rule, BeamBatch& batch,
                    Echoes& echoes) const {
    beams_.castGroups(now, robot, pan_rad, info_.range_max_m, batch, [&](std::size_t g, const BeamBatch& cast) {
      const auto& beams = beams_.groups()[g].beam_of_slot;
      if (!cast.hasNoCandidates()) {
        setEchoes(fields_of_group_[g], rule, cast.distancesBySlot(), beams, echoes);
      } else if (rule.pans()) {
        static thread_local std::vector<double> nothing_m;
        nothing_m.assign(beams.size(), kInfinity);
        setEchoes(fields_of_group_[g], rule, nothing_m, beams, echoes);
      } else if (beams.size() == echoes.size()) {
        std::copy(no_echoes_.begin(), no_echoes_.end(), echoes.begin());
      } else {
        for (const auto beam : beams) echoes[beam] = no_echoes_[beam];
      }
    });
  }

  void senseWithNoise(const Snapshot& now, std::uint32_t robot, std::size_t slot, double pan_rad,
                      Echoes& echoes) const {
    static thread_local std::vector<double> hit_m;
    hit_m.assign(beams_.size(), kInfinity);
    beams_.cast(now, robot, pan_rad, info_.range_max_m,
                [&](std::size_t i, double distance_m, BodyId) { hit_m[i] = distance_m; });
    addNoise(now.noise(robot, slot), hit_m);
    setEchoes(fields_, EchoRule(info_, PlanarTransform(PlanarTransform(), pan_rad)), hit_m, echoes);
  }

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
  std::vector<BeamFields> fields_of_group_;  ///< PlanarBeams::groups(), by slot
  Echoes no_echoes_;                         ///< of all beams without pan and without hits
};

}  // namespace

std::unique_ptr<Sensor> makeThinBeams(const SensorInfo& info, const RangeNoise& noise) {
  return std::make_unique<ThinBeams>(info, noise);
}

}  // namespace robosim
