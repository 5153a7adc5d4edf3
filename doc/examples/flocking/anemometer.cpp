#include <cmath>
#include <memory>
#include <vector>

#include <mrpt/obs/CObservationWindSensor.h>
#include <robosim/base/portable_math.h>
#include <robosim/recording/codec.h>

#include "types.h"

namespace {

using mrpt::obs::CObservationWindSensor;
using robosim::Quantity;
using robosim::SensorInfo;
using robosim::Values;

constexpr double kDegrees = 180 / 3.14159265358979323846;

const std::vector<Quantity>& windQuantities() {
  static const std::vector<Quantity> quantities{{"wind_speed", "m/s"}, {"wind_direction", "degrees"}};
  return quantities;
}

struct AnemometerOptions {
  std::string label = "anemometer";
  double wind_mps = 1;
  double wind_rad = 0;       ///< direction of the flow, world frame
  double noise_std_mps = 0;  ///< of each component
};

class Anemometer : public robosim::Sensor {
 public:
  explicit Anemometer(const AnemometerOptions& options) : options_(options) {
    info_.kind = robosim::SensorKind::values;
    info_.label = options.label;
    info_.quantities = windQuantities();
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return options_.noise_std_mps > 0; }
  double robotReach(double) const override { return 0; }  // other robots do not affect it

  void sense(const robosim::Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<robosim::Readings> readings) const override {
    for (const auto robot : robots) {
      // The wind in the robot's frame, minus the robot's own velocity. portable:: functions give the same digest on
      // every machine.
      const double heading_rad = now.world_from_robot[robot].phi;
      const auto [sin, cos] = robosim::portable::sincos(options_.wind_rad - heading_rad);
      const double own_mps = now.time.step == 0 ? 0 : now.last_motion[robot].length_m / now.time.period_s;
      double ahead_mps = options_.wind_mps * cos - own_mps;
      double left_mps = options_.wind_mps * sin;
      if (options_.noise_std_mps > 0) {
        auto noise = now.noise(robot, slot);
        ahead_mps += options_.noise_std_mps * noise.gaussian();
        left_mps += options_.noise_std_mps * noise.gaussian();
      }
      readings[robot].measurements[slot] = Values{{std::sqrt(ahead_mps * ahead_mps + left_mps * left_mps),
                                                   robosim::portable::atan2(left_mps, ahead_mps) * kDegrees}};
    }
  }

 private:
  AnemometerOptions options_;
  SensorInfo info_;
};

/// Records the two quantities as MRPT's class for wind.
class WindCodec : public robosim::CodecOf<CObservationWindSensor, Values> {
 public:
  bool encodes(const SensorInfo& sensor) const override {
    return sensor.kind == robosim::SensorKind::values && sensor.quantities == windQuantities();
  }

 private:
  void set(CObservationWindSensor& wind, const SensorInfo&, const Values& measured, float) const override {
    wind.speed = measured.values[0];
    wind.direction = measured.values[1];
  }
  Values get(const CObservationWindSensor& wind, const SensorInfo&, float) const override {
    return {{wind.speed, wind.direction}};
  }
  /// For `robosim replay --print`.
  bool append(const CObservationWindSensor& wind, robosim::ObservedNumbers& all) const override {
    all.push_back({"wind_speed", {}, robosim::kMetrePerSecond, wind.speed});
    all.push_back({"wind_direction", {}, {"degrees", "°"}, wind.direction});
    return true;
  }
};

}  // namespace

robosim::SensorType anemometerType() {
  return {"anemometer", "The apparent wind: speed and direction of its flow in the robot's frame.", true,
          [](robosim::XmlReader& reader, const robosim::Mount&) -> std::unique_ptr<robosim::Sensor> {
            AnemometerOptions o;
            o.label = reader.word("label", o.label);
            o.wind_mps = reader.number("wind_mps", robosim::Bounds::notNegative(100), o.wind_mps);
            o.wind_rad = reader.angle("wind_deg", {-360, 360}, o.wind_rad);
            if (auto noise = reader.child("noise")) {
              o.noise_std_mps = noise->number("std_mps", robosim::Bounds::notNegative(10), 0.1);
              noise->finish();
            }
            return std::make_unique<Anemometer>(o);
          },
          nullptr};
}

const robosim::Codec& windCodec() { return robosim::theCodec<WindCodec>(); }
