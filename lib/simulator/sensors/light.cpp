#include "sensors/light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hardware/numbered_quantities.h"
#include "sensors/beam_mounts.h"
#include "sensors/line_of_sight.h"

namespace robosim {
namespace {

constexpr double kNearest_m = 0.01;

struct LightOptions {
  SensorInfo info;
  double max_lx = std::numeric_limits<double>::infinity();  ///< a larger illuminance reads this
  double std_share = 0;                                     ///< standard deviation as a share of the reading, [0, 1]
  double std_lx = 0;                                        ///< standard deviation at any reading
};

class Light : public Sensor {
 public:
  explicit Light(const LightOptions& options) : options_(options) {
    for (const Beam& beam : options_.info.beams) axes_.push_back({originOf(beam), directionOf(beam)});
  }

  const SensorInfo& info() const override { return options_.info; }
  bool isNoisy() const override { return options_.std_share > 0 || options_.std_lx > 0; }
  bool usesNeighbours() const override { return false; }  // lights are up to range_max_m away
  double robotReach(double) const override { return beamReach(options_.info); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& values = std::get<Values>(readings[robot].measurements[slot]).values;
      Rng rng = now.noise(robot, slot);
      for (std::size_t i = 0; i < values.size(); ++i) {
        double lux = illuminanceAt(now, robot, axes_[i]);
        if (isNoisy()) lux += (options_.std_share * lux + options_.std_lx) * rng.gaussian();
        values[i] = asFloat(std::clamp(lux, 0.0, options_.max_lx));
      }
    }
  }

 private:
  double illuminanceAt(const Snapshot& now, std::uint32_t robot, const Ray& axis) const {
    const auto from = now.frames[robot].pointToWorld(axis.origin);
    const auto direction = now.frames[robot].pointToWorld(axis.origin + axis.direction) - from;
    double lux = 0;
    for (const FeaturedBody& light : now.featured) {
      if (light.body.light_cd == 0 || !light.is_present || light.id == now.bodyOf(robot)) continue;
      const auto& pose = light.body.world_from_body;
      const mrpt::math::TPoint3D to{pose.x, pose.y, light.body.center_z_m};
      const auto way = to - from;
      const double along_m = way.x * direction.x + way.y * direction.y + way.z * direction.z;
      const double distance_m = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
      if (along_m <= 0 || distance_m > options_.info.range_max_m) continue;
      if (!isInSight(now.scene, from, to, now.bodyOf(robot), light.id)) continue;
      const double at_m = std::max(distance_m, kNearest_m);
      lux += light.body.light_cd * (along_m / distance_m) / (at_m * at_m);
    }
    return lux;
  }

  LightOptions options_;
  std::vector<Ray> axes_;  ///< by value, robot frame
};

}  // namespace

std::unique_ptr<Sensor> readLight(XmlReader& reader, const Mount&) {
  LightOptions o;
  o.info.kind = SensorKind::values;
  o.info.label = reader.word("label", "light");
  o.info.beams = readBeamMounts(reader);
  o.info.quantities = numberedQuantities(o.info.beams.size(), {{"light", "lx"}});
  o.info.range_max_m = reader.number("range_max_m", Bounds::positive(1000), 50);
  if (reader.has("max_lx")) o.max_lx = reader.number("max_lx", Bounds::positive(1e9));
  if (auto noise = reader.child("noise")) {
    o.std_share = noise->number("std_share", {0, 1}, 0.05);
    o.std_lx = noise->number("std_lx", Bounds::notNegative(1e6), 0);
    noise->finish();
  }
  return std::make_unique<Light>(o);
}

}  // namespace robosim
