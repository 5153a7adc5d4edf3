#include "sensors/sonar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/portable_math.h"
#include "sensors/beam_mounts.h"
#include "sensors/planar_beams.h"
#include "sensors/sonar_echo.h"
#include "sensors/sonar_interference.h"
#include "sensors/thin_beams.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

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

/// Sonars next to each other by mounting angle, whose pings a sonar may receive: index of the next one clockwise and
/// counter-clockwise; nullopt if none faces the same side.
using AdjacentSonars = std::array<std::optional<std::size_t>, 2>;

/// By sonar. Adjacent are those between whose axes no other axis lies, and which are at most 90° apart.
std::vector<AdjacentSonars> adjacentSonars(const std::vector<Beam>& beams) {
  constexpr double kApartMax_rad = M_PI_2 + 1e-9;
  const std::size_t n = beams.size();
  std::vector<double> angle_rad;
  for (const Beam& beam : beams) {
    const double turns = beam.robot_from_beam.yaw / (2 * M_PI);
    angle_rad.push_back((turns - std::floor(turns)) * 2 * M_PI);
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return angle_rad[a] < angle_rad[b]; });
  std::vector<AdjacentSonars> adjacent(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t here = order[k], next = order[(k + 1) % n];
    const double apart_rad = angle_rad[next] - angle_rad[here] + (k + 1 == n ? 2 * M_PI : 0);
    if (apart_rad > kApartMax_rad) continue;
    adjacent[here][1] = next;
    adjacent[next][0] = here;
  }
  return adjacent;
}

SensorInfo infoOf(const SonarOptions& options) {
  return {.kind = SensorKind::sonar,
          .label = options.label,
          .beams = options.beams,
          .range_min_m = options.range_min_m,
          .range_max_m = options.range_max_m,
          .no_echo_m = options.no_echo_m,
          .beam_width_rad = options.beam_width_rad,
          .noise_std_m = options.noise.range.stdAt(options.range_max_m),
          .pans = false,
          .times = {.rate_hz = options.firing.isSimultaneous() ? 0 : 1 / options.firing.interval_s}};
}

class Sonar : public Sensor {
 public:
  explicit Sonar(const SonarOptions& options)
      : options_(options),
        info_(infoOf(options)),
        adjacent_(adjacentSonars(options.beams)),
        axes_(options.beams),
        reflector_(options_.noise, options.range_max_m) {
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
  // The readings of sonars that do not fire are those of the last step, which replicas do not have.
  bool needsHostProcess() const override { return !options_.firing.isSimultaneous(); }
  double robotReach(double) const override { return beamReach(info_); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      const PlanarTransform& frame = now.frames[robot];
      static thread_local std::vector<Detection> detections;
      detectAll(now, robot, frame, detections);
      if (options_.noise.range.on) addNoise(now, robot, slot, frame, detections);
      if (options_.firing.isSimultaneous()) {
        for (std::size_t i = 0; i < sonars_.size(); ++i) echoes[i] = echoOf(i, detections[i]);
      } else {
        for (std::size_t i = 0; i < sonars_.size(); ++i) {
          if (options_.firing.fires(i, now.time)) echoes[i] = echoOf(i, detections[i]);
        }
      }
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
    const SonarNoise& noise = options_.noise;
    Rng rng = now.noise(robot, slot);
    for (std::size_t i = 0; i < sonars_.size(); ++i) {
      if (!options_.firing.fires(i, now.time)) continue;
      if (noise.hasReflections() && detections[i].body != kNoBody)
        reflect(now, robot, frame, sonars_[i], detections[i]);
      if (noise.blanking_m > 0) applyBlanking(detections[i]);
      // Drawn without an echo too, so that a sonar's noise does not depend on the echoes of the others.
      detections[i].range_m = noise.range.apply(detections[i].range_m, rng);
    }
    if (noise.crosstalk > 0) addCrosstalk(now, rng, detections);
    if (noise.ringing > 0 || noise.robot_crosstalk > 0) addFalseEchoes(now, robot, slot, frame, detections);
  }

  /// Replaces what the ping has met by the echo that returns.
  void reflect(const Snapshot& now, std::uint32_t robot, const PlanarTransform& frame, const MountedSonar& sonar,
               Detection& detection) const {
    const Ray axis = computeAxis(frame, sonar);
    const BodyId owner = now.bodyOf(robot);
    SonarEcho met{detection.range_m, frame.turnToWorld(detection.direction),
                  frame.pointToWorld(sonar.origin + detection.direction * detection.range_m)};
    auto echo = reflector_.direct(now.scene, owner, axis, met, detection.body);
    if (echo == met) return;
    BodyId body = std::exchange(detection, Detection()).body;
    if (!echo && options_.noise.lobe.on && options_.model == SonarModel::sector) {
      // The nearest body is too far aside. What lies ahead may still return the ping.
      const Hit ahead = now.scene.castRay(axis, options_.range_max_m, owner);
      if (!ahead) return;
      met = {ahead.distance_m, axis.direction, ahead.point};
      body = ahead.body;
      echo = reflector_.direct(now.scene, owner, axis, met, body);
    }
    if (!echo && options_.noise.has_second_echoes) echo = reflector_.second(now.scene, owner, axis, met, body);
    if (echo) detection = {echo->range_m, frame.turnToFrame(echo->direction), body};
  }

  static Ray computeAxis(const PlanarTransform& frame, const MountedSonar& sonar) {
    return {frame.pointToWorld(sonar.origin), frame.turnToWorld(sonar.axis)};
  }

  /// An echo during the blanking is lost. The ping continues between the sonar and the object, and its first repetition
  /// after the blanking is read.
  void applyBlanking(Detection& detection) const {
    const double blanking_m = options_.noise.blanking_m;
    if (!(detection.range_m < blanking_m)) return;
    if (detection.range_m <= 0) {
      detection = {};
      return;
    }
    detection.range_m *= std::ceil(blanking_m / detection.range_m);
  }

  /// Adds echoes of ringing and the pings of other robots.
  void addFalseEchoes(const Snapshot& now, std::uint32_t robot, std::size_t slot, const PlanarTransform& frame,
                      std::vector<Detection>& detections) const {
    const SonarNoise& noise = options_.noise;
    const double ringing_m = std::max(noise.blanking_m, options_.range_min_m);
    Rng rng = now.noise(robot, slot, 1);
    std::optional<Rng> ranges;  // seldom needed
    for (std::size_t i = 0; i < detections.size(); ++i) {
      // One number of 32 bits decides both: low ones ring, high ones may receive a ping.
      const double number = rng() * 0x1p-32;
      const bool rings = number < noise.ringing, may_receive = 1 - number <= noise.robot_crosstalk;
      Detection& detection = detections[i];
      if (rings && ringing_m < detection.range_m) detection = {ringing_m, sonars_[i].axis, kNoBody};
      if (!may_receive || !options_.firing.fires(i, now.time)) continue;
      if (!ranges) ranges.emplace(now.noise(robot, slot, 2));
      const double range_m = std::max(noise.blanking_m, ranges->uniform() * options_.range_max_m);
      const double half_rad = noise.lobe.on ? noise.lobe.wall_rad : options_.beam_width_rad / 2;
      if (range_m >= detection.range_m) continue;
      if (mayReceivePing(now, robot, computeAxis(frame, sonars_[i]), half_rad, options_.range_max_m)) {
        detection = {range_m, sonars_[i].axis, kNoBody};
      }
    }
  }

  /// A sonar receives the ping of an adjacent one only in a step in which that fires.
  void addCrosstalk(const Snapshot& now, Rng& rng, std::vector<Detection>& detections) const {
    // The neighbours' own echoes, so that an echo does not propagate around the ring.
    static thread_local std::vector<Detection> own;
    own = detections;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const bool mixed = rng.uniform() < options_.noise.crosstalk;
      const auto other = adjacent_[i][rng.below(2)];
      if (!mixed || !other || !options_.firing.fires(*other, now.time)) continue;
      if (own[*other].range_m < own[i].range_m) detections[i] = {own[*other].range_m, sonars_[i].axis, kNoBody};
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
  std::vector<AdjacentSonars> adjacent_;
  PlanarBeams axes_;  ///< for the model `rays` with one ray per sonar
  SonarReflector reflector_;
};

}  // namespace

std::unique_ptr<Sensor> makeSonar(const SonarOptions& options) {
  // A single ray that fires in every step, without noise, is a thin beam.
  if (options.model == SonarModel::rays && options.rays == 1 && !options.noise.range.on &&
      options.firing.isSimultaneous()) {
    return makeThinBeams(infoOf(options), {});
  }
  return std::make_unique<Sonar>(options);
}

}  // namespace robosim
