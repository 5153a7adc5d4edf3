#include "sensors/battery.h"

#include <algorithm>
#include <cmath>

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
  bool isNoisy() const override { return options_.load.noise_std_v > 0; }
  double robotReach(double) const override { return 0; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    if (now.time.step == 0) return;  // the battery is still full
    if (options_.load.on) return senseLoaded(now, robots, slot, readings);
    for (const auto robot : robots) {
      const Motion& motion = now.last_motion[robot];
      const bool drives = motion.length_m != 0 || motion.turn_rad != 0 || motion.lateral_m != 0;
      const double lasts_s = drives ? options_.driving_s : options_.standing_s;
      double& voltage_v = std::get<Scalar>(readings[robot].measurements[slot]).value;
      voltage_v -= (options_.full_v - options_.empty_v) * now.time.period_s / lasts_s;
      voltage_v = std::max(voltage_v, options_.empty_v);
    }
  }

 private:
  void senseLoaded(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
                   std::span<Readings> readings) const {
    const BatteryLoad& load = options_.load;
    const double range_v = options_.full_v - options_.empty_v;
    const double by_distance = (1 / options_.driving_s - 1 / options_.standing_s) / load.speed_mps;
    for (const auto robot : robots) {
      const Motion& motion = now.last_motion[robot];
      const double driven_m = now.driven_m.empty() ? 0 : now.driven_m[robot];
      double voltage_v =
          options_.full_v - range_v * (now.time.seconds() / options_.standing_s + driven_m * by_distance);
      voltage_v -= (load.drop_v_per_mps * groundLength(motion) + load.drop_v_per_radps * std::abs(motion.turn_rad)) /
                   now.time.period_s;
      if (load.noise_std_v > 0) voltage_v += load.noise_std_v * now.noise(robot, slot).gaussian();
      std::get<Scalar>(readings[robot].measurements[slot]).value = std::max(voltage_v, options_.empty_v);
    }
  }

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
  if (auto noise = reader.child("noise")) {
    BatteryLoad& load = o.load;
    load.drop_v_per_mps = noise->number("drop_v_per_mps", Bounds::notNegative(100), load.drop_v_per_mps);
    load.drop_v_per_radps = noise->number("drop_v_per_radps", Bounds::notNegative(100), load.drop_v_per_radps);
    load.speed_mps = noise->number("speed_mps", Bounds::positive(100), load.speed_mps);
    load.noise_std_v = noise->number("std_v", Bounds::notNegative(100), load.noise_std_v);
    load.on = load.drop_v_per_mps > 0 || load.drop_v_per_radps > 0 || load.noise_std_v > 0;
    noise->finish();
  }
  if (o.empty_v >= o.full_v) reader.errorAt("empty_v", "must be below full_v");
  return o;
}

std::unique_ptr<Sensor> makeBattery(const BatteryOptions& options) { return std::make_unique<Battery>(options); }

}  // namespace robosim
