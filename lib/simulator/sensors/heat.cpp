#include "sensors/heat.h"

#include <algorithm>
#include <cmath>

#include "sensors/position_2005.h"

namespace robosim {
namespace {

class Heat : public Sensor {
 public:
  explicit Heat(const HeatOptions& options) : options_(options) {
    info_.kind = SensorKind::heat;
    info_.label = options.label;
    info_.range_max_m = options.range_max_m;
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return options_.noise_std > 0; }
  double robotReach(double) const override { return 0; }  // but that of hot robots is unlimited

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      const auto& pose = now.world_from_robot[robot];
      double sum = 0;
      for (const auto& source : now.heat_sources) {
        if (source.body == now.bodyOf(robot)) continue;
        sum += heatAt(options_, source.heat_celsius, (source.center - mrpt::math::TPoint2D(pose.x, pose.y)).norm());
      }
      double noise = options_.noise_std > 0 ? options_.noise_std * now.noise(robot, slot).gaussian() : 0;
      if (options_.lag_s > 0 && now.time.step > 0) {
        const double old = std::get<Scalar>(readings[robot].measurements[slot]).value;
        const double share = now.time.period_s / (now.time.period_s + options_.lag_s);
        sum = old + share * (sum - old);
        noise *= std::sqrt(share * (2 - share));  // so that the filter's output has the given deviation
      }
      sum += noise;
      // Single precision, as in MRPT's observations, so that a recorded reading equals the reading.
      readings[robot].measurements[slot] = Scalar{static_cast<float>(sum)};
    }
  }

 private:
  HeatOptions options_;
  SensorInfo info_;
};

HeatLaw readLaw(XmlReader& reader) {
  return reader.choice<HeatLaw>("law", {{"linear", HeatLaw::linear}, {"inverse", HeatLaw::inverse}}, HeatLaw::linear);
}

void readHeatNoise(XmlReader& reader, HeatOptions& options) {
  auto element = reader.child("noise");
  if (!element) return;
  options.noise_std = element->number("std", Bounds::notNegative(1000), 0.5);
  options.lag_s = element->number("lag_s", Bounds::notNegative(3600), 0);
  element->finish();
}

}  // namespace

HeatOptions HeatOptions::read(XmlReader& reader) {
  HeatOptions o;
  o.label = reader.word("label", o.label);
  o.law = readLaw(reader);
  o.range_max_m = reader.number("range_max_m", Bounds::positive(1e6), o.range_max_m);
  readHeatNoise(reader, o);
  return o;
}

HeatOptions HeatOptions::read2005(XmlReader& reader, const Mount& mount) {
  HeatOptions o;
  o.law = readLaw(reader);
  o.range_max_m = Position2005::read(reader, mount).range_m;
  o.unit_m = mount.unit_m;
  readHeatNoise(reader, o);
  return o;
}

double heatAt(const HeatOptions& options, double heat_celsius, double distance_m) {
  if (distance_m > options.range_max_m) return 0;
  if (options.law == HeatLaw::linear) return heat_celsius * (1 - distance_m / options.range_max_m);
  return heat_celsius / std::max(0.01, distance_m / options.unit_m);
}

std::unique_ptr<Sensor> makeHeat(const HeatOptions& options) { return std::make_unique<Heat>(options); }

}  // namespace robosim
