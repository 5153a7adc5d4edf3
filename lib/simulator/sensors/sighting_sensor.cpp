#include "sensors/sighting_sensor.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "sensors/beam_mounts.h"
#include "sensors/line_of_sight.h"

namespace robosim {

SightingOptions SightingOptions::read(XmlReader& reader, const char* label, double range_max_m, double z_m,
                                      std::vector<Quantity> (*quantities)(std::size_t count)) {
  SightingOptions o;
  o.info.kind = SensorKind::values;
  o.info.label = reader.word("label", label);
  o.info.range_max_m = reader.number("range_max_m", Bounds::positive(100), range_max_m);
  const double count = reader.number("count", {1, 64}, static_cast<double>(o.count));
  if (count != std::floor(count)) reader.errorAt("count", "must be a whole number");
  o.count = static_cast<std::size_t>(count);
  o.info.quantities = quantities(o.count);
  const double x_m = reader.number("x_m", {-100, 100}, 0), y_m = reader.number("y_m", {-100, 100}, 0);
  const double at_z_m = reader.number("z_m", Bounds::notNegative(100), z_m);
  o.info.beams.push_back(planarBeam(x_m, y_m, at_z_m, reader.angle("angle_deg", {-360, 360}, 0)));
  o.field_of_view_rad = reader.angle("field_of_view_deg", Bounds::positive(360), o.field_of_view_rad);
  if (auto noise = reader.child("noise")) {
    o.noise = RangeNoise::read(*noise, {.on = true, .std_m = 0.05});
    o.bearing_std_rad = noise->angle("bearing_std_deg", {0, 180}, 5 * kRadPerDeg);
    o.info.noise_std_m = o.noise.stdAt(o.info.range_max_m);
    o.info.bearing_std_rad = o.bearing_std_rad;
    noise->finish();
  }
  return o;
}

SightingSensor::SightingSensor(const SightingOptions& options)
    : options_(options), record_(options.info.quantities.size() / options.count) {}

double SightingSensor::robotReach(double) const {
  const auto at = originOf(options_.info.beams.front());
  return options_.info.range_max_m + portable::hypot(at.x, at.y);
}

Measurement SightingSensor::blank() const {
  Values none;
  none.values.resize(options_.count * record_);
  for (std::size_t i = 0; i < none.values.size(); i += record_) none.values[i] = -1;
  return none;
}

void SightingSensor::sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
                           std::span<Readings> readings) const {
  const auto& mount = options_.info.beams.front().robot_from_beam;
  const double reach_m = robotReach(0);
  std::vector<Sighting> all;
  for (const auto robot : robots) {
    const auto from = now.frames[robot].pointToWorld(originOf(options_.info.beams.front()));
    const double heading_rad = now.world_from_robot[robot].phi + mount.yaw;
    all.clear();
    find(now, robot, reach_m, all);
    for (Sighting& thing : all) thing.distance_m = portable::hypot(thing.at.x - from.x, thing.at.y - from.y);
    std::stable_sort(all.begin(), all.end(),
                     [](const Sighting& a, const Sighting& b) { return a.distance_m < b.distance_m; });
    Rng rng = now.noise(robot, slot);
    auto& values = std::get<Values>(readings[robot].measurements[slot]).values;
    values = std::get<Values>(blank()).values;
    std::size_t place = 0;
    for (const Sighting& thing : all) {
      if (place == options_.count || thing.distance_m > options_.info.range_max_m) break;
      const double bearing_rad = wrapped(portable::atan2(thing.at.y - from.y, thing.at.x - from.x) - heading_rad);
      if (std::abs(bearing_rad) > options_.field_of_view_rad / 2) continue;
      if (!isInSight(now.scene, from, thing.at, now.bodyOf(robot), thing.body)) continue;
      if (measure(thing, bearing_rad, heading_rad, rng, &values[record_ * place])) ++place;
    }
  }
}

bool SightingSensor::measure(const Sighting& thing, double bearing_rad, double heading_rad, Rng& rng,
                             double* record) const {
  double range_m = thing.distance_m;
  double orientation_rad = thing.heading_rad - heading_rad;
  if (options_.noise.on) {
    range_m = options_.noise.apply(range_m, rng);
    bearing_rad += options_.bearing_std_rad * rng.gaussian();
    if (record_ > 3) orientation_rad += options_.bearing_std_rad * rng.gaussian();
    if (!std::isfinite(range_m)) return false;
  }
  record[0] = thing.distance_m > options_.what_range_m ? 0 : thing.what;
  record[1] = asFloat(range_m);
  record[2] = asFloat(wrapped(bearing_rad));
  if (record_ > 3) record[3] = asFloat(wrapped(orientation_rad));
  return true;
}

}  // namespace robosim
