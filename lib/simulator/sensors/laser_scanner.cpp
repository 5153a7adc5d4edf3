#include "sensors/laser_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>

#include "base/portable_math.h"
#include "sensors/beam_echoes.h"
#include "sensors/beam_footprint.h"
#include "sensors/planar_beams.h"
#include "sensors/scan_errors.h"
#include "sensors/swept_rays.h"

namespace robosim {
namespace {

constexpr double kSlack = 1e-9;  ///< more than rounding errors

class LaserScanner : public Sensor {
 public:
  LaserScanner(const SensorInfo& info, const LaserErrors& errors, const LaserTiming& timing)
      : info_(info),
        errors_(errors),
        scan_errors_(errors, info),
        timing_(timing),
        beams_(info.beams),
        swept_(beams_.rays()) {
    info_.times = timing.times;
    for (std::size_t i = 0; i < beams_.size(); ++i) fields_.add(beams_[i]);
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return errors_.isRandom() || timing_.latency_std_s > 0; }
  bool needsHostProcess() const override { return timing_.times.rate_hz > 0; }
  double robotReach(double speed_max_mps) const override {
    // A scan's age that is distributed normally has no limit.
    if (timing_.latency_std_s > 0) return Sensor::robotReach(speed_max_mps);
    return beamReach(info_) + speed_max_mps * (timing_.sweep_s + timing_.interlace_s + timing_.latency_s);
  }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    if (!timing_.times.isDue(now.time)) return;
    // Reused for all robots of a thread. On the heap, because the compiler treats each access to a thread's variable as
    // a call, around which it spills the registers of its loops.
    static thread_local const auto memory = std::make_unique<BeamHits>();
    BeamHits& hits = *memory;
    for (const auto robot : robots) {
      const double pan_rad = info_.pans ? now.laser_pan_rad[robot] : 0;
      hits.reset(beams_, now.frames[robot], pan_rad);
      cast(now, robot, slot, pan_rad, hits);
      if (has_errors_) applyErrors(now, robot, slot, hits);
      setEchoes(fields_, EchoRule(info_, PlanarTransform(PlanarTransform(), pan_rad)), hits.distance_m,
                std::get<Echoes>(readings[robot].measurements[slot]));
    }
  }

 private:
  void cast(const Snapshot& now, std::uint32_t robot, std::size_t slot, double pan_rad, BeamHits& hits) const {
    const Motion& motion = now.last_motion[robot];
    const bool has_moved = motion.length_m != 0 || motion.turn_rad != 0 || motion.lateral_m != 0;
    const double latency_s = has_moved ? timing_.drawLatency(now, robot, slot, beams_.size()) : 0;
    if (has_moved && (timing_.sweep_s > 0 || timing_.interlace_s > 0 || latency_s > 0)) {
      return castSwept(now, robot, latency_s, pan_rad, hits);
    }
    beams_.cast(now, robot, pan_rad, info_.range_max_m,
                [&](std::size_t i, double distance_m, BodyId body) { hits.set(i, distance_m, body); });
  }

  void castSwept(const Snapshot& now, std::uint32_t robot, double latency_s, double pan_rad, BeamHits& hits) const {
    const Motion& motion = now.last_motion[robot];
    const double period_s = now.time.period_s;
    const std::size_t last = beams_.size() - 1;
    const double step_s = last > 0 ? timing_.sweep_s / static_cast<double>(last) : 0;
    const double sweep_s = step_s * static_cast<double>(last);
    const double oldest = (latency_s + sweep_s + timing_.interlace_s) / period_s;
    const std::array<double, 2> first_shares{oldest, (latency_s + sweep_s) / period_s};
    swept_.place(now.frames[robot], motion, pan_rad, std::span(first_shares).first(timing_.interlace_s > 0 ? 2 : 1),
                 step_s / period_s, hits.moved);
    hits.is_moved = true;
    const std::span<const Ray> rays(hits.moved.data(), beams_.size());
    const double turn_rad = std::abs(motion.turn_rad) * oldest * (1 + kSlack);
    const auto hit = [&](std::size_t i, double distance_m, BodyId body) { hits.set(i, distance_m, body); };
    if (turn_rad <= 1) {
      // A mount is displaced by the motion and by the turn of its arm.
      const double arm_m = portable::hypot(beams_[0].origin.x, beams_[0].origin.y);
      const double shift_m = (groundLength(motion) * oldest + arm_m * turn_rad) * (1 + kSlack);
      return beams_.castMoved(now, robot, pan_rad, info_.range_max_m,
                              {.rays = rays, .shift_m = shift_m, .turn_rad = turn_rad}, hit);
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit found = now.scene.castRay(rays[i], info_.range_max_m, now.bodyOf(robot));
      if (found) hit(i, found.distance_m, found.body);
    }
  }

  void applyErrors(const Snapshot& now, std::uint32_t robot, std::size_t slot, BeamHits& hits) const {
    BeamFootprint footprint(now, errors_);
    scan_errors_.apply(now, robot, slot, hits.distance_m, [&](std::size_t i, const auto& distortion) {
      if (!is_lit_) return Return{hits.distance_m[i]};
      const int side = footprint.mixingSide(hits, i);
      return side == 0 ? footprint.computeReturn(hits, i) : footprint.mixed(hits, i, side, distortion());
    });
  }

  SensorInfo info_;
  LaserErrors errors_;
  ScanErrors scan_errors_;
  LaserTiming timing_;
  PlanarBeams beams_;
  SweptRays swept_;
  BeamFields fields_;
  bool has_errors_ = !scan_errors_.areNone();
  bool is_lit_ = errors_.divergence_rad > 0 || errors_.reach_m > 0;  ///< the returned light matters
};

}  // namespace

void LaserTiming::read(XmlReader& reader) {
  sweep_s = reader.number("sweep_s", Bounds::notNegative(10), sweep_s);
  latency_s = reader.number("latency_s", Bounds::notNegative(10), 0);
  latency_std_s = reader.number("latency_std_s", Bounds::notNegative(10), 0);
  latency_tail = reader.number("latency_tail", {0, 1}, 0);
  latency_tail_factor = reader.number("latency_tail_factor", {1, 100}, latency_tail_factor);
  if (latency_tail > 0 && latency_std_s == 0) {
    reader.errorAt("latency_tail", "multiplies latency_std_s, which is 0; set latency_std_s");
  }
  times.rate_hz = reader.number("rate_hz", Bounds::notNegative(1000), 0);
  times.phase_s = reader.number("phase_s", Bounds::notNegative(1e6), 0);
}

double LaserTiming::drawLatency(const Snapshot& now, std::uint32_t robot, std::size_t slot, std::size_t beams) const {
  if (latency_std_s == 0) return latency_s;
  Rng rng(now.seed, RandomPurpose::sensor_noise, robot, static_cast<std::uint32_t>(slot), now.time.step);
  rng.skipToBlock(static_cast<std::uint32_t>(beams));
  const double normal = rng.gaussian();
  const bool is_in_tail = latency_tail > 0 && rng.uniform() < latency_tail;
  const double std_s = latency_std_s * (is_in_tail ? latency_tail_factor : 1);
  return std::max(0.0, latency_s + std_s * normal);
}

std::unique_ptr<Sensor> makeLaserScanner(const SensorInfo& info, const LaserErrors& errors, const LaserTiming& timing) {
  return std::make_unique<LaserScanner>(info, errors, timing);
}

}  // namespace robosim
