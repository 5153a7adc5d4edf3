#include "sensors/reflectance.h"

#include "sensors/planar_beams.h"

namespace robosim {
namespace {

class Reflectance final : public Sensor {
 public:
  explicit Reflectance(const SensorInfo& laser) : info_(laser), beams_(laser.beams) {}

  const SensorInfo& info() const override { return info_; }
  bool needsHostProcess() const override { return true; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      for (auto& echo : echoes) echo.range_m = 0;
      beams_.cast(now, robot, 0, info_.range_max_m, [&](std::size_t i, double distance_m, BodyId body) {
        if (distance_m < info_.range_max_m) echoes[i].range_m = static_cast<float>(now.reflectivityOf(body));
      });
    }
  }

 private:
  SensorInfo info_;
  PlanarBeams beams_;
};

}  // namespace

std::unique_ptr<Sensor> makeReflectance(const SensorInfo& laser) { return std::make_unique<Reflectance>(laser); }

}  // namespace robosim
