#include "sensors/compass.h"

#include <cmath>

#include <mrpt/math/wrap2pi.h>

#include "base/angle_units.h"

namespace robosim {
namespace {

class Compass : public Sensor {
 public:
  explicit Compass(const CompassOptions& options) : options_(options) {
    info_.kind = SensorKind::compass;
    info_.label = options.label;
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return options_.noise_std_rad > 0; }
  double robotReach(double) const override { return 0; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      double heading_rad = now.world_from_robot[robot].phi;
      if (!options_.deviation.isNone()) heading_rad += options_.deviation.at(heading_rad);
      if (options_.gyro_drift_radps != 0) heading_rad += options_.gyro_drift_radps * now.time.seconds();
      if (options_.noise_std_rad > 0) heading_rad += options_.noise_std_rad * now.noise(robot, slot).gaussian();
      readings[robot].measurements[slot] = Scalar{mrpt::math::wrapToPi(heading_rad)};
    }
  }

 private:
  CompassOptions options_;
  SensorInfo info_;
};

}  // namespace

CompassOptions CompassOptions::read(XmlReader& reader) {
  CompassOptions o;
  o.label = reader.word("label", o.label);
  if (auto element = reader.child("noise")) {
    o.noise_std_rad = element->angle("std_deg", Bounds::notNegative(180), 2 * kRadPerDeg);
    o.deviation = CompassDeviation::read(*element);
    constexpr double kHour_s = 3600;
    o.gyro_drift_radps = toRadians(element->number("gyro_drift_deg_per_h", {-36000, 36000}, 0)) / kHour_s;
    element->finish();
  }
  return o;
}

std::unique_ptr<Sensor> makeCompass(const CompassOptions& options) { return std::make_unique<Compass>(options); }

}  // namespace robosim
