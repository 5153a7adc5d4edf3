#include "sensors/sonar.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "sensors/beam_mounts.h"
#include "sensors/planar_beams.h"
#include "sensors/position_2005.h"
#include "sensors/thin_beams.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

constexpr double kRadPerDeg = M_PI / 180;

/// Polaroid 6500 ranging module with the 600 series transducer, as on Pioneer and Scout: ±1 % of the range (data
/// sheet).
constexpr RangeNoise kSonarDataSheet{.on = true, .std_m = 0, .std_per_m = 0.01, .dropout = 0};
/// Smooth walls reflect the ping away beyond about half the beam width of the transducer (Leonard & Durrant-Whyte,
/// *Directed Sonar Sensing for Mobile Robot Navigation*, 1992, ch. 2).
constexpr double kSpecular_deg = 15;

/// Directions that fill a cone about x: one on the axis, the others on a sunflower spiral, which distributes any number
/// evenly (Vogel, "A better way to construct the sunflower head", 1979). The last one lies on the cone's surface.
std::vector<TPoint3D> coneDirections(int rays, double half_width_rad) {
  const double golden_rad = M_PI * (3 - std::sqrt(5.0));
  std::vector<TPoint3D> directions;
  for (int i = 0; i < rays; ++i) {
    const double off = rays == 1 ? 0 : half_width_rad * std::sqrt(static_cast<double>(i) / (rays - 1));
    const double around = i * golden_rad;
    const auto aside = portable::sincos(off);
    const auto spiral = portable::sincos(around);
    directions.emplace_back(aside.cos, aside.sin * spiral.cos, aside.sin * spiral.sin);
  }
  return directions;
}

/// A sonar's geometry at its mounting pose.
struct MountedSonar {
  TPoint3D origin;
  TPoint3D axis;
  std::vector<TPoint3D> rays;  ///< of the bundle, robot frame
};

struct Detection {
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
          .noise_std_m = options.noise.range.stdAt(options.range_max_m),
          .pans = false};
}

class Sonar : public Sensor {
 public:
  explicit Sonar(const SonarOptions& options) : options_(options), info_(infoOf(options)), axes_(options.beams) {
    const double half_rad = options.beam_width_rad / 2;
    const auto cone = coneDirections(options.model == SonarModel::rays ? options.rays : 0, half_rad);
    for (const auto& beam : options.beams) {
      const double yaw = beam.robot_from_beam.yaw;
      MountedSonar sonar{originOf(beam), directionOf(beam), {}};
      const PlanarTransform turned({0, 0, yaw}, 0);
      for (const auto& ray : cone) sonar.rays.push_back(turned.turnToWorld(ray));
      sonars_.push_back(std::move(sonar));
    }
    for (const auto& [z_m, sonars] : beamsByHeight(options.beams)) {
      std::vector<Sector> sectors;
      for (const auto i : sonars) {
        sectors.push_back(Sector::towards(sonars_[i].origin, options.beams[i].robot_from_beam.yaw, half_rad));
      }
      groups_.push_back({sonars, BeamFan(sectors)});
    }
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return options_.noise.range.on; }
  std::size_t rayCount() const override { return options_.rayCount(); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const PlanarTransform& frame = now.frames[robot];
      static thread_local std::vector<Detection> detections;
      detectAll(now, robot, frame, detections);
      if (options_.noise.range.on) addNoise(now, robot, slot, frame, detections);
      for (std::size_t i = 0; i < sonars_.size(); ++i) echoes[i] = echoOf(i, detections[i]);
    }
  }

 private:
  void detectAll(const Snapshot& now, std::uint32_t robot, const PlanarTransform& frame,
                 std::vector<Detection>& detections) const {
    detections.assign(sonars_.size(), {});
    if (options_.model == SonarModel::rays && options_.rays == 1) {
      axes_.cast(now, robot, 0, options_.range_max_m, [&](std::size_t i, double distance_m, BodyId body) {
        if (body != kNoBody) detections[i] = {distance_m, sonars_[i].axis, body};
      });
      return;
    }
    if (options_.model == SonarModel::sector) return detectWithSectors(now, robot, frame, detections);
    for (std::size_t i = 0; i < sonars_.size(); ++i) detections[i] = detectWithRays(now, robot, frame, sonars_[i]);
  }

  void detectWithSectors(const Snapshot& now, std::uint32_t robot, const PlanarTransform& frame,
                         std::vector<Detection>& detections) const {
    static thread_local BeamBatch batch;  // reused for all robots of a thread
    for (const auto& group : groups_) {
      batch.place(group.fan, frame, options_.range_max_m);
      now.scene.cast(batch, now.bodyOf(robot));
      for (std::size_t k = 0; k < group.sonars.size(); ++k) {
        if (batch.body(k) == BeamBatch::kNothing) continue;
        const std::size_t i = group.sonars[k];
        const TPoint3D out = frame.turnToFrame(TPoint3D(batch.towards(k).x, batch.towards(k).y, 0));
        detections[i] = echoFrom(sonars_[i], batch.distance(k), out, BodyId(static_cast<std::uint32_t>(batch.body(k))));
      }
    }
  }

  /// @param out vector from the sonar to the echo's origin, robot frame
  static Detection echoFrom(const MountedSonar& sonar, double distance_m, const TPoint3D& out, BodyId body) {
    return {distance_m, distance_m > 0 ? out * (1 / distance_m) : sonar.axis, body};
  }

  Detection detectWithRays(const Snapshot& now, std::uint32_t robot, const PlanarTransform& frame,
                           const MountedSonar& sonar) const {
    const TPoint3D origin = frame.pointToWorld(sonar.origin);
    Detection nearest;
    for (const auto& ray : sonar.rays) {
      const double reach = std::min(nearest.range_m, options_.range_max_m);
      const Hit hit = now.scene.castRay({origin, frame.turnToWorld(ray)}, reach, now.bodyOf(robot));
      if (hit) nearest = {hit.distance_m, ray, hit.body};
    }
    return nearest;
  }

  /// The echo as reported by the hardware.
  Echo echoOf(std::size_t sonar, const Detection& detection) const {
    const auto range = static_cast<float>(detection.range_m);
    if (!(range < static_cast<float>(options_.range_max_m))) {
      return {static_cast<float>(options_.no_echo_m),
              pointAlong(sonars_[sonar].origin, sonars_[sonar].axis, static_cast<float>(options_.no_echo_m))};
    }
    return {std::max(range, static_cast<float>(options_.range_min_m)),
            pointAlong(sonars_[sonar].origin, detection.direction, range)};
  }

  void addNoise(const Snapshot& now, std::uint32_t robot, std::size_t slot, const PlanarTransform& frame,
                std::vector<Detection>& detections) const {
    Rng rng = now.noise(robot, slot);
    for (std::size_t i = 0; i < sonars_.size(); ++i) {
      if (detections[i].body != kNoBody && isSpecular(now, frame, sonars_[i], detections[i])) detections[i] = {};
      // Drawn without an echo too, so that a sonar's noise does not depend on the echoes of the others.
      detections[i].range_m = options_.noise.range.apply(detections[i].range_m, rng);
    }
    if (options_.noise.crosstalk > 0) addCrosstalk(rng, detections);
  }

  bool isSpecular(const Snapshot& now, const PlanarTransform& frame, const MountedSonar& sonar,
                  const Detection& detection) const {
    if (options_.noise.specular_rad >= M_PI || detection.range_m <= 0) return false;
    const TPoint3D met = frame.pointToWorld(sonar.origin + detection.direction * detection.range_m);
    const TPoint3D out = frame.turnToWorld(detection.direction);
    const TPoint2D normal = normalAt(now.scene.solid(detection.body).outline, {met.x, met.y});
    const double straightness = -(out.x * normal.x + out.y * normal.y) / portable::hypot(out.x, out.y);
    return straightness < portable::cos(options_.noise.specular_rad);
  }

  void addCrosstalk(Rng& rng, std::vector<Detection>& detections) const {
    // The neighbours' own echoes, so that an echo does not propagate around the ring.
    const std::vector<Detection> own = detections;
    const std::size_t n = own.size();
    for (std::size_t i = 0; i < n; ++i) {
      const bool mixed = rng.uniform() < options_.noise.crosstalk;
      const std::size_t other = (i + (rng.below(2) ? 1 : n - 1)) % n;
      if (mixed && own[other].range_m < own[i].range_m) detections[i] = {own[other].range_m, sonars_[i].axis, kNoBody};
    }
  }

  /// Sonars at one height, as a BeamFan requires.
  struct HeightGroup {
    std::vector<std::size_t> sonars;
    BeamFan fan;
  };

  SonarOptions options_;
  SensorInfo info_;
  std::vector<MountedSonar> sonars_;
  std::vector<HeightGroup> groups_;  ///< for the model `sector`
  PlanarBeams axes_;                 ///< for the model `rays` with one ray per sonar
};

SonarModel readModel(XmlReader& reader, SonarModel otherwise) {
  return reader.choice<SonarModel>("model", {{"sector", SonarModel::sector}, {"rays", SonarModel::rays}}, otherwise);
}

SonarNoise readSonarNoise(XmlReader& reader) {
  SonarNoise noise;
  if (auto element = reader.child("noise")) {
    noise.range = RangeNoise::read(*element, kSonarDataSheet);
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
  o.noise = readSonarNoise(reader);
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
  // In the table the four sonars that face straight sideways are mounted 0.5 before or behind the centre of a robot of
  // radius 3.
  const double aside_m = mount.robot_radius_m / 6;
  const double bearings_deg[] = {-90, -50, -30, -10, 10, 30, 50, 90, 90, 130, 150, 170, -170, -150, -130, -90};
  for (int i = 0; i < (mode == 1 ? 8 : 16); ++i) {
    const double angle = bearings_deg[i] * kRadPerDeg;
    const bool faces_sideways = std::abs(bearings_deg[i]) == 90;
    const auto [sin, cos] = portable::sincos(angle);
    const double x_m = faces_sideways ? (i < 8 ? aside_m : -aside_m) : mount.robot_radius_m * cos;
    o.beams.push_back(planarBeam(x_m, mount.robot_radius_m * sin, position.z_m, angle));
  }
  o.noise = readSonarNoise(reader);
  return o;
}

std::size_t SonarOptions::rayCount() const {
  return beams.size() * (model == SonarModel::rays ? static_cast<std::size_t>(rays) : 1);
}

std::unique_ptr<Sensor> makeSonar(const SonarOptions& options) {
  // A single ray without noise is a thin beam.
  if (options.model == SonarModel::rays && options.rays == 1 && !options.noise.range.on) {
    return makeThinBeams(infoOf(options), {});
  }
  return std::make_unique<Sonar>(options);
}

}  // namespace robosim
