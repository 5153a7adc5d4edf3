#include "sensors/range_and_bearing.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "geometry/shapes/path.h"
#include "hardware/numbered_quantities.h"
#include "sensors/beam_mounts.h"
#include "sensors/line_of_sight.h"
#include "sensors/range_noise.h"

namespace robosim {
namespace {

struct RangeAndBearingOptions {
  SensorInfo info;
  std::size_t count = 6;  ///< largest number of neighbours that are measured, [1, 64]
  double z_m = 0.1;       ///< height of the board above the robot's underside, [0, 10]
  RangeNoise noise;
  double bearing_std_rad = 0;  ///< [0, π]
};

/// Another robot within range.
struct Candidate {
  double distance_m;
  std::uint32_t robot;
  bool operator<(const Candidate& other) const {
    return distance_m != other.distance_m ? distance_m < other.distance_m : robot < other.robot;
  }
};

class RangeAndBearing : public Sensor {
 public:
  explicit RangeAndBearing(const RangeAndBearingOptions& options) : options_(options) {}
  const SensorInfo& info() const override { return options_.info; }
  bool isNoisy() const override { return options_.noise.on; }
  std::size_t rayCount() const override { return options_.count; }
  bool usesNeighbours() const override { return false; }  // those are stationary solids
  double robotReach(double) const override { return options_.info.range_max_m; }

  Measurement blank() const override {
    Values none;
    for (std::size_t i = 0; i < options_.count; ++i) {
      const double values[] = {-1, 0, 0};
      none.values.insert(none.values.end(), std::begin(values), std::end(values));
    }
    return none;
  }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    std::vector<std::uint32_t> found;
    std::vector<Candidate> candidates;
    for (const auto robot : robots) {
      findCandidates(now, robot, found, candidates);
      Rng rng = now.noise(robot, slot);
      auto& values = std::get<Values>(readings[robot].measurements[slot]).values;
      std::size_t place = 0;
      for (const Candidate& candidate : candidates) {
        if (place == options_.count) break;
        if (isInSight(now, robot, candidate)) place += measure(now, robot, candidate, rng, &values[3 * place]) ? 1 : 0;
      }
      for (; place < options_.count; ++place) {
        values[3 * place] = -1;
        values[3 * place + 1] = values[3 * place + 2] = 0;
      }
    }
  }

 private:
  void findCandidates(const Snapshot& now, std::uint32_t robot, std::vector<std::uint32_t>& found,
                      std::vector<Candidate>& candidates) const {
    const auto& own = now.world_from_robot[robot];
    now.scene.findMoving({own.x, own.y}, options_.info.range_max_m, now.world_from_robot.size(), found);
    candidates.clear();
    for (const auto other : found) {
      if (other == robot) continue;
      const auto& pose = now.world_from_robot[other];
      const double distance_m = portable::hypot(pose.x - own.x, pose.y - own.y);
      if (distance_m <= options_.info.range_max_m) candidates.push_back({distance_m, other});
    }
    std::sort(candidates.begin(), candidates.end());
  }

  /// Whether the other robot is the first body on the line between the centres.
  bool isInSight(const Snapshot& now, std::uint32_t robot, const Candidate& other) const {
    if (other.distance_m == 0) return true;
    const auto from = now.frames[robot].pointToWorld({0, 0, options_.z_m});
    const auto& to = now.world_from_robot[other.robot];
    const mrpt::math::TPoint3D direction{(to.x - from.x) / other.distance_m, (to.y - from.y) / other.distance_m, 0};
    return now.scene.castRay({from, direction}, other.distance_m, now.bodyOf(robot)).body == now.bodyOf(other.robot);
  }

  /// @return false for a measurement that is lost
  bool measure(const Snapshot& now, std::uint32_t robot, const Candidate& other, Rng& rng, double* values) const {
    const auto& own = now.world_from_robot[robot];
    const auto& to = now.world_from_robot[other.robot];
    double range_m = other.distance_m;
    double bearing_rad = portable::atan2(to.y - own.y, to.x - own.x) - own.phi;
    if (options_.noise.on) {
      range_m = options_.noise.apply(range_m, rng);
      bearing_rad += options_.bearing_std_rad * rng.gaussian();
      if (!std::isfinite(range_m)) return false;
    }
    values[0] = other.robot;
    values[1] = asFloat(range_m);
    values[2] = asFloat(wrapped(bearing_rad));
    return true;
  }

  RangeAndBearingOptions options_;
};

}  // namespace

std::unique_ptr<Sensor> readRangeAndBearing(XmlReader& reader, const Mount&) {
  RangeAndBearingOptions o;
  o.info.kind = SensorKind::values;
  o.info.label = reader.word("label", "range_and_bearing");
  o.info.range_max_m = reader.number("range_max_m", Bounds::positive(100), 3);
  const double count = reader.number("count", {1, 64}, static_cast<double>(o.count));
  if (count != std::floor(count)) reader.errorAt("count", "must be a whole number");
  o.count = static_cast<std::size_t>(count);
  o.z_m = reader.number("z_m", Bounds::notNegative(10), o.z_m);
  o.info.quantities = neighbourQuantities(o.count);
  o.info.beams.push_back(planarBeam(0, 0, o.z_m, 0));
  if (auto noise = reader.child("noise")) {
    o.noise = RangeNoise::read(*noise, {.on = true, .std_m = 0.05});
    o.bearing_std_rad = noise->angle("bearing_std_deg", {0, 180}, 5 * kRadPerDeg);
    o.info.noise_std_m = o.noise.stdAt(o.info.range_max_m);
    o.info.bearing_std_rad = o.bearing_std_rad;
    noise->finish();
  }
  return std::make_unique<RangeAndBearing>(o);
}

}  // namespace robosim
