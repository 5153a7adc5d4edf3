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
  ThinBeams(const SensorInfo& info, const RangeNoise& noise) : info_(info), noise_(noise), beams_(info.beams) {}

  const SensorInfo& info() const override { return info_; }
  Measurement blank() const override { return Echoes(beams_.size()); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const double pan_rad = info_.pans ? now.laser_pan_rad[robot] : 0;
      const LevelFrame pan = pan_rad == 0 ? LevelFrame() : LevelFrame({0, 0, pan_rad}, 0);
      Rng rng = now.noise(robot, slot);
      beams_.cast(now, robot, pan_rad, info_.range_max_m, [&](std::size_t i, double distance_m, BodyId body) {
        double range_m = distance_m;
        // Infinite for nothing, which no noise brings back.
        if (noise_.on) range_m = noise_.apply(body == kNoBody ? kInfinity : distance_m, rng);
        const bool heard = static_cast<float>(range_m) < static_cast<float>(info_.range_max_m);
        const double told_m = heard ? std::max(range_m, info_.range_min_m) : info_.no_echo_m;
        const TPoint3D direction = pan_rad != 0 ? pan.turnToWorld(beams_[i].direction) : beams_[i].direction;
        echoes[i] = {static_cast<float>(told_m), pointAlong(beams_[i].origin, direction, heard ? range_m : told_m)};
      });
    }
  }

 private:
  SensorInfo info_;
  RangeNoise noise_;
  LevelBeams beams_;
};

}  // namespace

std::unique_ptr<Sensor> makeThinBeams(const SensorInfo& info, const RangeNoise& noise) {
  return std::make_unique<ThinBeams>(info, noise);
}

}  // namespace robosim
