#include "sensors/battery.h"

#include <algorithm>

namespace robosim {
namespace {

class Battery : public Sensor {
 public:
  explicit Battery(const BatteryOptions& options) : options_(options) {
    info_.kind = SensorKind::battery;
    info_.label = options.label;
  }

  const SensorInfo& info() const override { return info_; }
  Measurement blank() const override { return Scalar{options_.full_v}; }
  bool sensesInHostProcess() const override { return true; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    if (now.time.step == 0) return;  // the battery is still full
    for (const auto robot : robots) {
      const Motion& motion = now.last_motion[robot];
      const bool drives = motion.length_m != 0 || motion.turn_rad != 0;
      const double lasts_s = drives ? options_.driving_s : options_.standing_s;
      double& voltage_v = std::get<Scalar>(readings[robot].measurements[slot]).value;
      voltage_v -= (options_.full_v - options_.empty_v) * now.time.period_s / lasts_s;
      voltage_v = std::max(voltage_v, options_.empty_v);
    }
  }

 private:
  BatteryOptions options_;
  SensorInfo info_;
};

}  // namespace

BatteryOptions BatteryOptions::read(XmlReader& reader) {
  BatteryOptions o;
  o.label = reader.word("label", o.label);
  o.full_v = reader.number("full_v", Bounds::positive(1000), o.full_v);
  o.empty_v = reader.number("empty_v", Bounds::notNegative(1000), o.empty_v);
  constexpr double hour_s = 3600;
  o.standing_s = hour_s * reader.number("standing_h", Bounds::positive(1e6), o.standing_s / hour_s);
  o.driving_s = hour_s * reader.number("driving_h", Bounds::positive(1e6), o.driving_s / hour_s);
  if (o.empty_v >= o.full_v) reader.errorAt("empty_v", "must be below full_v");
  return o;
}

std::unique_ptr<Sensor> makeBattery(const BatteryOptions& options) { return std::make_unique<Battery>(options); }

}  // namespace robosim
