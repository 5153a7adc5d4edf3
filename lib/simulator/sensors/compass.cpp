#include "sensors/compass.h"

#include <cmath>

#include <mrpt/math/wrap2pi.h>

#include "base/angle_units.h"
#include "base/portable_math.h"

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

CompassDeviation CompassDeviation::read(XmlReader& noise) {
  CompassDeviation d;
  d.offset_rad = noise.angle("offset_deg", {-180, 180}, 0);
  d.hard_iron_rad = noise.angle("hard_iron_deg", {0, 90}, 0);
  d.hard_iron_at_rad = noise.angle("hard_iron_at_deg", {-360, 360}, 0);
  d.soft_iron_rad = noise.angle("soft_iron_deg", {0, 90}, 0);
  d.soft_iron_at_rad = noise.angle("soft_iron_at_deg", {-360, 360}, 0);
  return d;
}

double CompassDeviation::at(double heading_rad) const {
  double error_rad = offset_rad;
  if (hard_iron_rad != 0) error_rad += hard_iron_rad * portable::sin(heading_rad - hard_iron_at_rad);
  if (soft_iron_rad != 0) error_rad += soft_iron_rad * portable::sin(2 * (heading_rad - soft_iron_at_rad));
  return error_rad;
}

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
