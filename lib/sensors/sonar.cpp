#include "sensors/sonar.h"

#include <algorithm>
#include <cmath>

#include "sensors/beam_mounts.h"
#include "sensors/level_beams.h"
#include "sensors/position_2005.h"
#include "sensors/thin_beams.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

constexpr double kRadPerDeg = M_PI / 180;

/// Polaroid 6500 ranging module with the 600 series transducer, as on Pioneer and Scout: ±1 % of the range (data
/// sheet).
constexpr RangeNoise kDataSheet{.on = true, .std_m = 0, .std_per_m = 0.01, .dropout = 0};
/// Smooth walls mirror the ping away beyond about half the beam width of the transducer (Leonard & Durrant-Whyte,
/// *Directed Sonar Sensing for Mobile Robot Navigation*, 1992, ch. 2).
constexpr double kSpecular_deg = 15;

/// Directions that fill a cone about x: one on the axis, the rest on a sunflower's spiral, which spreads any number
/// evenly (Vogel, "A better way to construct the sunflower head", 1979). The last lies on the cone itself.
std::vector<TPoint3D> coneDirections(int rays, double half_width_rad) {
  const double golden_rad = M_PI * (3 - std::sqrt(5.0));
  std::vector<TPoint3D> directions;
  for (int i = 0; i < rays; ++i) {
    const double off = rays == 1 ? 0 : half_width_rad * std::sqrt(static_cast<double>(i) / (rays - 1));
    const double around = i * golden_rad;
    directions.emplace_back(std::cos(off), std::sin(off) * std::cos(around), std::sin(off) * std::sin(around));
  }
  return directions;
}

/// One sonar, worked out for its place on the robot.
struct MountedSonar {
  TPoint3D origin;
  TPoint3D axis;
  std::vector<TPoint3D> rays;  ///< of the bundle, robot frame
};

struct Heard {
  double range_m = std::numeric_limits<double>::infinity();
  TPoint3D direction;  ///< robot frame, unit vector
  BodyId body = kNoBody;
};

SensorInfo infoOf(const SonarOptions& options) {
  return {.kind = SensorKind::sonar,
          .label = options.label,
          .beams = options.beams,
          .range_min_m = options.range_min_m,
          .range_max_m = options.range_max_m,
          .no_echo_m = options.no_echo_m,
          .beam_width_rad = options.beam_width_rad,
          .noise_std_m = options.noise.range.on ? options.noise.range.std_m : 0,
          .pans = false};
}

class Sonar : public Sensor {
 public:
  explicit Sonar(const SonarOptions& options) : options_(options), info_(infoOf(options)), axes_(options.beams) {
    const double half_rad = options.beam_width_rad / 2;
    const auto cone = coneDirections(options.rays, half_rad);
    for (const auto& beam : options.beams) {
      const double yaw = beam.robot_from_beam.yaw;
      MountedSonar sonar{originOf(beam), directionOf(beam), {}};
      const LevelFrame turned({0, 0, yaw}, 0);
      for (const auto& ray : cone) sonar.rays.push_back(turned.turnToWorld(ray));
      sonars_.push_back(std::move(sonar));
    }
    for (const auto& [z_m, sonars] : beamsByHeight(options.beams)) {
      std::vector<Sector> sectors;
      for (const auto i : sonars) {
        sectors.push_back(Sector::towards(sonars_[i].origin, options.beams[i].robot_from_beam.yaw, half_rad));
      }
      tiers_.push_back({sonars, SectorFan(sectors)});
    }
  }

  const SensorInfo& info() const override { return info_; }
  Measurement blank() const override { return Echoes(sonars_.size()); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const LevelFrame& frame = now.frames[robot];
      static thread_local std::vector<Heard> heard;
      hearAll(now, robot, frame, heard);
      if (options_.noise.range.on) addNoise(now, robot, slot, frame, heard);
      for (std::size_t i = 0; i < sonars_.size(); ++i) echoes[i] = told(i, heard[i]);
    }
  }

 private:
  void hearAll(const Snapshot& now, std::uint32_t robot, const LevelFrame& frame, std::vector<Heard>& heard) const {
    heard.assign(sonars_.size(), {});
    if (options_.model == SonarModel::rays && options_.rays == 1) {
      axes_.cast(now, robot, 0, options_.range_max_m, [&](std::size_t i, double distance_m, BodyId body) {
        if (body != kNoBody) heard[i] = {distance_m, sonars_[i].axis, body};
      });
      return;
    }
    if (options_.model == SonarModel::sector) return hearSectors(now, robot, frame, heard);
    for (std::size_t i = 0; i < sonars_.size(); ++i) heard[i] = hearBundle(now, robot, frame, sonars_[i]);
  }

  void hearSectors(const Snapshot& now, std::uint32_t robot, const LevelFrame& frame, std::vector<Heard>& heard) const {
    static thread_local SectorBatch batch;  // its arrays serve all robots of a thread
    for (const auto& tier : tiers_) {
      batch.place(tier.fan, frame, options_.range_max_m);
      now.scene.senseSectors(batch, now.bodyOf(robot), now.near[robot]);
      for (std::size_t k = 0; k < tier.sonars.size(); ++k) {
        if (batch.body(k) == SectorBatch::kNothing) continue;
        const std::size_t i = tier.sonars[k];
        const TPoint3D out = frame.turnToFrame(TPoint3D(batch.towards(k).x, batch.towards(k).y, 0));
        heard[i] = echoFrom(sonars_[i], batch.distance(k), out, BodyId(static_cast<std::uint32_t>(batch.body(k))));
      }
    }
  }

  /// @param out from the sonar to what it hears, robot frame
  static Heard echoFrom(const MountedSonar& sonar, double distance_m, const TPoint3D& out, BodyId body) {
    return {distance_m, distance_m > 0 ? out * (1 / distance_m) : sonar.axis, body};
  }

  Heard hearBundle(const Snapshot& now, std::uint32_t robot, const LevelFrame& frame, const MountedSonar& sonar) const {
    const TPoint3D origin = frame.pointToWorld(sonar.origin);
    Heard nearest;
    for (const auto& ray : sonar.rays) {
      const double reach = std::min(nearest.range_m, options_.range_max_m);
      const Hit hit = now.scene.castRay({origin, frame.turnToWorld(ray)}, reach, now.bodyOf(robot));
      if (hit) nearest = {hit.distance_m, ray, hit.body};
    }
    return nearest;
  }

  /// The echo as the hardware tells it.
  Echo told(std::size_t sonar, const Heard& heard) const {
    const auto range = static_cast<float>(heard.range_m);
    if (!(range < static_cast<float>(options_.range_max_m))) {
      return {static_cast<float>(options_.no_echo_m),
              pointAlong(sonars_[sonar].origin, sonars_[sonar].axis, static_cast<float>(options_.no_echo_m))};
    }
    return {std::max(range, static_cast<float>(options_.range_min_m)),
            pointAlong(sonars_[sonar].origin, heard.direction, range)};
  }

  void addNoise(const Snapshot& now, std::uint32_t robot, std::size_t slot, const LevelFrame& frame,
                std::vector<Heard>& heard) const {
    Rng rng = now.noise(robot, slot);
    for (std::size_t i = 0; i < sonars_.size(); ++i) {
      if (heard[i].body != kNoBody && mirrorsAway(now, frame, sonars_[i], heard[i])) heard[i] = {};
      // Drawn for silence too, so that one sonar's luck does not depend on what another hears.
      heard[i].range_m = options_.noise.range.apply(heard[i].range_m, rng);
    }
    if (options_.noise.crosstalk > 0) mixNeighbours(rng, heard);
  }

  bool mirrorsAway(const Snapshot& now, const LevelFrame& frame, const MountedSonar& sonar, const Heard& heard) const {
    if (options_.noise.specular_rad >= M_PI || heard.range_m <= 0) return false;
    const TPoint3D met = frame.pointToWorld(sonar.origin + heard.direction * heard.range_m);
    const TPoint3D out = frame.turnToWorld(heard.direction);
    const TPoint2D normal = normalAt(now.scene.solid(heard.body).outline, {met.x, met.y});
    const double straightness = -(out.x * normal.x + out.y * normal.y) / std::hypot(out.x, out.y);
    return straightness < std::cos(options_.noise.specular_rad);
  }

  void mixNeighbours(Rng& rng, std::vector<Heard>& heard) const {
    // Neighbours' echoes as they were, so that an echo does not wander round the ring.
    const std::vector<Heard> own = heard;
    const std::size_t n = own.size();
    for (std::size_t i = 0; i < n; ++i) {
      const bool mixed = rng.uniform() < options_.noise.crosstalk;
      const std::size_t other = (i + (rng.below(2) ? 1 : n - 1)) % n;
      if (mixed && own[other].range_m < own[i].range_m) heard[i] = {own[other].range_m, sonars_[i].axis, kNoBody};
    }
  }

  /// Sonars of one height: a fan of sectors has one.
  struct Tier {
    std::vector<std::size_t> sonars;
    SectorFan fan;
  };

  SonarOptions options_;
  SensorInfo info_;
  std::vector<MountedSonar> sonars_;
  std::vector<Tier> tiers_;  ///< for the model of sectors
  LevelBeams axes_;          ///< for the model of one ray a sonar
};

SonarModel readModel(XmlReader& reader, SonarModel otherwise) {
  return reader.choice<SonarModel>("model", {{"sector", SonarModel::sector}, {"rays", SonarModel::rays}}, otherwise);
}

SonarNoise readNoise(XmlReader& reader) {
  SonarNoise noise;
  if (auto element = reader.child("noise")) {
    noise.range = RangeNoise::read(*element, kDataSheet);
    noise.specular_rad = element->angle("specular_deg", {0, 180}, kSpecular_deg * kRadPerDeg);
    noise.crosstalk = element->number("crosstalk", Bounds::notNegative(1), 0);
    element->finish();
  }
  return noise;
}

int readRays(XmlReader& reader, int otherwise) {
  const double rays = reader.number("rays", {1, 1000}, otherwise);
  if (rays != std::floor(rays)) reader.errorAt("rays", "must be a whole number");
  return static_cast<int>(rays);
}

}  // namespace

SonarOptions SonarOptions::read(XmlReader& reader) {
  SonarOptions o;
  o.label = reader.word("label", o.label);
  o.model = readModel(reader, o.model);
  o.rays = readRays(reader, o.rays);
  o.beams = readBeamMounts(reader);
  o.range_max_m = reader.number("range_max_m", Bounds::positive(100), o.range_max_m);
  o.range_min_m = reader.number("range_min_m", Bounds::notNegative(o.range_max_m), 0);
  o.no_echo_m = reader.number("no_echo_m", {o.range_max_m, 1000}, o.range_max_m);
  o.beam_width_rad = reader.angle("beam_width_deg", Bounds::positive(120), o.beam_width_rad);
  o.noise = readNoise(reader);
  return o;
}

SonarOptions SonarOptions::read2005(XmlReader& reader, const Mount& mount) {
  SonarOptions o;
  const Position2005 position = Position2005::read(reader, mount);
  o.model = readModel(reader, o.model);
  o.rays = readRays(reader, o.rays);
  o.range_max_m = position.range_m;
  o.no_echo_m = position.range_m + mount.unit_m;
  const double mode = reader.number("mode", {1, 2}, 2);
  if (mode != 1 && mode != 2) reader.errorAt("mode", "must be 1 (8 sonars in front) or 2 (16 all round)");
  // In the table the four sonars that look straight aside sit 0.5 before or behind the centre of a robot of radius 3.
  const double aside_m = mount.robot_radius_m / 6;
  const double bearings_deg[] = {-90, -50, -30, -10, 10, 30, 50, 90, 90, 130, 150, 170, -170, -150, -130, -90};
  for (int i = 0; i < (mode == 1 ? 8 : 16); ++i) {
    const double angle = bearings_deg[i] * kRadPerDeg;
    const bool looks_aside = std::abs(bearings_deg[i]) == 90;
    const double x_m = looks_aside ? (i < 8 ? aside_m : -aside_m) : mount.robot_radius_m * std::cos(angle);
    o.beams.push_back(levelBeam(x_m, mount.robot_radius_m * std::sin(angle), position.z_m, angle));
  }
  o.noise = readNoise(reader);
  return o;
}

std::unique_ptr<Sensor> makeSonar(const SonarOptions& options) {
  // One ray without its errors is any thin beam.
  if (options.model == SonarModel::rays && options.rays == 1 && !options.noise.range.on) {
    return makeThinBeams(infoOf(options), {});
  }
  return std::make_unique<Sonar>(options);
}

}  // namespace robosim
