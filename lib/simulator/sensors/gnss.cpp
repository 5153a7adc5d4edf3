#include "sensors/gnss.h"

#include <array>
#include <cmath>

#include "base/portable_math.h"
#include "hardware/gnss_fix.h"
#include "sensors/beam_mounts.h"
#include "world/georeference.h"

namespace robosim {
namespace {

struct GnssOptions {
  mrpt::math::TPoint3D robot_from_antenna;  ///< [m]
  bool is_noisy = false;
  double horizontal_std_m = 0, vertical_std_m = 0;  ///< of the slow errors; horizontal: of each axis
  double correlation_s = 60;
  double white_std_m = 0;  ///< of each axis and fix
  double dropout = 0;      ///< probability that a fix fails
};

class Gnss : public Sensor {
 public:
  Gnss(const GnssOptions& options, SensorInfo info) : options_(options), info_(std::move(info)) {}
  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return options_.is_noisy; }
  double robotReach(double) const override { return 0; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    if (!info_.times.isDue(now.time)) return;
    for (const auto robot : robots) {
      auto& values = std::get<Values>(readings[robot].measurements[slot]);
      values = GnssFix{}.values();
      if (!now.georeference) continue;
      auto antenna = now.frames[robot].pointToWorld(options_.robot_from_antenna);
      if (options_.is_noisy) {
        Rng white = now.noise(robot, slot);
        if (white.uniform() < options_.dropout) continue;
        const auto slow = slowErrors(now, robot, slot);
        antenna.x += options_.horizontal_std_m * slow[0] + options_.white_std_m * white.gaussian();
        antenna.y += options_.horizontal_std_m * slow[1] + options_.white_std_m * white.gaussian();
        antenna.z += options_.vertical_std_m * slow[2] + options_.white_std_m * white.gaussian();
      }
      const GeoPosition position = now.georeference->positionOf({antenna.x, antenna.y}, antenna.z);
      values = GnssFix{true, position.latitude_deg, position.longitude_deg, position.altitude_m}.values();
    }
  }

 private:
  /// Of variance 1: a cosine and a sine weight two values, so that their squares add up to 1 at any time between them.
  std::array<double, 3> slowErrors(const Snapshot& now, std::uint32_t robot, std::size_t slot) const {
    const double periods = now.time.seconds() / options_.correlation_s;
    const double before = std::floor(periods);
    const auto weight = portable::sincos((periods - before) * M_PI / 2);
    constexpr std::uint32_t kSlowStream = 1u << 20;  // Snapshot::noise() has the streams of the step
    const auto at = [&](double knot) {
      return Rng(now.seed, RandomPurpose::sensor_noise, robot, static_cast<std::uint32_t>(slot) | kSlowStream,
                 static_cast<std::uint64_t>(knot));
    };
    Rng first = at(before), second = at(before + 1);
    std::array<double, 3> errors{};
    for (double& error : errors) error = weight.cos * first.gaussian() + weight.sin * second.gaussian();
    return errors;
  }

  GnssOptions options_;
  SensorInfo info_;
};

}  // namespace

std::unique_ptr<Sensor> readGnss(XmlReader& reader, const Mount&) {
  GnssOptions o;
  SensorInfo info;
  info.kind = SensorKind::values;
  info.label = reader.word("label", "gnss");
  info.quantities = GnssFix::quantities();
  auto& at = o.robot_from_antenna;
  const auto coordinate = [&](const char* name, double otherwise) {
    return reader.number(name, {-100, 100}, otherwise);
  };
  at = {coordinate("x_m", 0), coordinate("y_m", 0), coordinate("z_m", 0)};
  info.times.rate_hz = reader.number("rate_hz", Bounds::notNegative(1000), 1);
  if (auto noise = reader.child("noise")) {
    o.is_noisy = true;
    // u-blox NEO-M8 data sheet (UBX-15031086): 2.5 m, the radius of half of the fixes (CEP), which is 1.1774 standard
    // deviations of an axis. The vertical error is about twice that; both are mostly slow.
    o.horizontal_std_m = noise->number("horizontal_std_m", Bounds::notNegative(1000), 2.1);
    o.vertical_std_m = noise->number("vertical_std_m", Bounds::notNegative(1000), 4.2);
    o.correlation_s = noise->number("correlation_s", Bounds::positive(1e6), o.correlation_s);
    o.white_std_m = noise->number("white_std_m", Bounds::notNegative(1000), 0.1);
    o.dropout = noise->number("dropout", {0, 1}, 0);
    info.noise_std_m = o.horizontal_std_m;
    noise->finish();
  }
  info.beams.push_back(planarBeam(at.x, at.y, at.z, 0));
  return std::make_unique<Gnss>(o, std::move(info));
}

}  // namespace robosim
