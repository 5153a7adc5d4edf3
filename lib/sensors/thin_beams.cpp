#include "sensors/thin_beams.h"

#include <algorithm>
#include <cmath>

#include "sensors/beam_mounts.h"

namespace robosim {
namespace {

using mrpt::math::TPoint3D;

class ThinBeams : public Sensor {
 public:
  ThinBeams(const SensorInfo& info, const RangeNoise& noise) : info_(info), noise_(noise) {
    for (const auto& beam : info.beams) rays_.push_back({originOf(beam), directionOf(beam)});
  }

  const SensorInfo& info() const override { return info_; }
  Measurement blank() const override { return Echoes(rays_.size()); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const RobotFrame frame = now.frameOf(robot);
      const RobotFrame pan({0, 0, info_.pans ? now.laser_pan_rad[robot] : 0.0}, 0);
      const BodyId self = now.bodyOf(robot);
      Rng rng = now.noise(robot, slot);
      for (std::size_t i = 0; i < rays_.size(); ++i) {
        const TPoint3D direction = info_.pans ? pan.turnToWorld(rays_[i].direction) : rays_[i].direction;
        const Ray ray{frame.pointToWorld(rays_[i].origin), frame.turnToWorld(direction)};
        double range_m = now.scene.castRay(ray, info_.range_max_m, self).distance_m;
        if (noise_.on) range_m = noise_.apply(range_m, rng);
        const bool met = static_cast<float>(range_m) < static_cast<float>(info_.range_max_m);
        const double told_m = met ? std::max(range_m, info_.range_min_m) : info_.no_echo_m;
        echoes[i] = {static_cast<float>(told_m), pointAlong(rays_[i].origin, direction, met ? range_m : told_m)};
      }
    }
  }

 private:
  SensorInfo info_;
  RangeNoise noise_;
  std::vector<Ray> rays_;  ///< robot frame, before panning
};

}  // namespace

std::unique_ptr<Sensor> makeThinBeams(const SensorInfo& info, const RangeNoise& noise) {
  return std::make_unique<ThinBeams>(info, noise);
}

}  // namespace robosim
