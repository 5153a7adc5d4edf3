#include "sensors/beacons.h"

#include <algorithm>

#include "geometry/shapes/path.h"
#include "sensors/beam_mounts.h"
#include "sensors/range_noise.h"

namespace robosim {
namespace {

struct BeaconsOptions {
  SensorInfo info;
  mrpt::math::TPoint3D antenna;               ///< robot frame [m]
  std::vector<mrpt::math::TPoint3D> beacons;  ///< world frame [m]
  RangeNoise noise;
  double wall_bias_m = 0;  ///< added to a range without line of sight, [0, 10]
};

class Beacons : public Sensor {
 public:
  explicit Beacons(const BeaconsOptions& options) : options_(options) {}
  const SensorInfo& info() const override { return options_.info; }
  bool isNoisy() const override { return options_.noise.on; }
  bool usesNeighbours() const override { return false; }  // its rays end at the beacons, up to 1 km away
  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      const auto antenna = now.frames[robot].pointToWorld(options_.antenna);
      auto& ranges = std::get<BeaconRanges>(readings[robot].measurements[slot]).range_m;
      Rng rng = now.noise(robot, slot);
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        const auto out = options_.beacons[i] - antenna;
        double range_m = out.norm();
        const double clear_m = range_m - kContactGap_m;  // a beacon on a wall is not behind it
        const bool is_behind = clear_m > 0 && now.scene.castRay({antenna, out / range_m}, clear_m, now.bodyOf(robot));
        if (is_behind) range_m += options_.wall_bias_m;
        if (options_.noise.on) range_m = options_.noise.apply(range_m, rng);
        ranges[i] = static_cast<float>(std::min(range_m, options_.info.no_echo_m));
      }
    }
  }

 private:
  BeaconsOptions options_;
};

}  // namespace

std::unique_ptr<Sensor> readBeacons(XmlReader& reader, const Mount&) {
  BeaconsOptions o;
  o.info.kind = SensorKind::beacons;
  o.info.label = reader.word("label", "beacons");
  o.info.range_max_m = o.info.no_echo_m = reader.number("range_max_m", Bounds::positive(1000), 50);
  o.antenna = readPosition(reader);
  if (auto noise = reader.child("noise")) {
    o.noise = RangeNoise::read(*noise, {.on = true, .std_m = 0.1});
    o.wall_bias_m = noise->number("wall_bias_m", Bounds::notNegative(10), 0.3);
    o.info.noise_std_m = o.noise.stdAt(o.info.range_max_m);
    noise->finish();
  }
  for (auto& beacon : reader.all("beacon")) {
    o.beacons.push_back(readPosition(beacon, 1e6));
    o.info.beams.push_back(planarBeam(o.antenna.x, o.antenna.y, o.antenna.z, 0));
    beacon.finish();
  }
  if (o.beacons.empty()) reader.error("has no beacon; add <beacon x_m=\"…\" y_m=\"…\" z_m=\"…\"/>");
  return std::make_unique<Beacons>(o);
}

}  // namespace robosim
