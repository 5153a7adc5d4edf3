#include "sensors/thin_beams.h"

#include <algorithm>
#include <limits>

#include "sensors/beam_mounts.h"
#include "sensors/level_beams.h"

namespace robosim {
namespace {

using mrpt::math::TPoint3D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class ThinBeams : public Sensor {
 public:
  ThinBeams(const SensorInfo& info, const RangeNoise& noise) : info_(info), noise_(noise), beams_(info.beams) {
    for (std::size_t i = 0; i < beams_.size(); ++i) silence_.push_back(silence(i, beams_[i].direction));
  }

  const SensorInfo& info() const override { return info_; }
  Measurement blank() const override { return Echoes(beams_.size()); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const double pan_rad = info_.pans ? now.laser_pan_rad[robot] : 0;
      const LevelFrame pan = pan_rad == 0 ? LevelFrame() : LevelFrame({0, 0, pan_rad}, 0);
      const auto direction = [&](std::size_t i) {
        return pan_rad != 0 ? pan.turnToWorld(beams_[i].direction) : beams_[i].direction;
      };
      std::copy(silence_.begin(), silence_.end(), echoes.begin());
      if (pan_rad != 0) {
        for (std::size_t i = 0; i < echoes.size(); ++i) echoes[i] = silence(i, direction(i));
      }
      const auto hear = [&](std::size_t i, double distance_m) {
        const auto range_m = static_cast<float>(distance_m);
        if (range_m >= static_cast<float>(info_.range_max_m)) return;
        echoes[i] = {std::max(range_m, static_cast<float>(info_.range_min_m)),
                     pointAlong(beams_[i].origin, direction(i), range_m)};
      };
      if (noise_.on) {
        // Every beam draws its own numbers, whatever the others meet.
        static thread_local std::vector<double> met_m;
        met_m.assign(beams_.size(), kInfinity);
        cast(now, robot, pan_rad, [&](std::size_t i, double distance_m) { met_m[i] = distance_m; });
        Rng rng = now.noise(robot, slot);
        for (std::size_t i = 0; i < met_m.size(); ++i) hear(i, noise_.apply(met_m[i], rng));
      } else {
        cast(now, robot, pan_rad, hear);
      }
    }
  }

 private:
  template <typename Visit>
  void cast(const Snapshot& now, std::uint32_t robot, double pan_rad, const Visit& visit) const {
    beams_.cast(now, robot, pan_rad, info_.range_max_m,
                [&](std::size_t i, double distance_m, BodyId) { visit(i, distance_m); });
  }
  /// What beam `i` tells when nothing is in range.
  Echo silence(std::size_t i, const TPoint3D& direction) const {
    const auto no_echo_m = static_cast<float>(info_.no_echo_m);
    return {no_echo_m, pointAlong(beams_[i].origin, direction, no_echo_m)};
  }

  SensorInfo info_;
  RangeNoise noise_;
  LevelBeams beams_;
  Echoes silence_;  ///< by beam, not panned
};

}  // namespace

std::unique_ptr<Sensor> makeThinBeams(const SensorInfo& info, const RangeNoise& noise) {
  return std::make_unique<ThinBeams>(info, noise);
}

}  // namespace robosim
