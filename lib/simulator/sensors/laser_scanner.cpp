#include "sensors/laser_scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.h"
#include "base/random_blocks.h"
#include "base/ziggurat.h"
#include "sensors/beam_echoes.h"
#include "sensors/beam_footprint.h"
#include "sensors/planar_beams.h"
#include "sensors/swept_pose.h"

namespace robosim {
namespace {

constexpr double kUnit = 0x1p-32;
constexpr double kSlack = 1e-9;  ///< more than rounding errors
constexpr double kNoHit_m = std::numeric_limits<double>::infinity();

class LaserScanner : public Sensor {
 public:
  LaserScanner(const SensorInfo& info, const LaserErrors& errors, const LaserTiming& timing)
      : info_(info), errors_(errors), process_(errors, info), timing_(timing), beams_(info.beams) {
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
    static thread_local BeamHits hits;  // reused for all robots of a thread
    const double drift_m = errors_.driftAt(now.time.seconds());
    for (const auto robot : robots) {
      const double pan_rad = info_.pans ? now.laser_pan_rad[robot] : 0;
      hits.reset(beams_, now.frames[robot], pan_rad);
      cast(now, robot, slot, pan_rad, hits);
      if (has_errors_) applyErrors(now, robot, slot, drift_m, hits);
      setEchoes(fields_, info_, PlanarTransform(PlanarTransform(), pan_rad), hits.distance_m,
                std::get<Echoes>(readings[robot].measurements[slot]));
    }
  }

 private:
  void cast(const Snapshot& now, std::uint32_t robot, std::size_t slot, double pan_rad, BeamHits& hits) const {
    const Motion& motion = now.last_motion[robot];
    const bool has_moved = motion.length_m != 0 || motion.turn_rad != 0;
    const double latency_s = has_moved ? drawLatency(now, robot, slot) : 0;
    if (has_moved && (timing_.sweep_s > 0 || timing_.interlace_s > 0 || latency_s > 0)) {
      return castSwept(now, robot, latency_s, pan_rad, hits);
    }
    beams_.cast(now, robot, pan_rad, info_.range_max_m,
                [&](std::size_t i, double distance_m, BodyId body) { hits.set(i, distance_m, body); });
  }

  /// Age of the last beam. Its random numbers are those of one beam more than the scanner has.
  double drawLatency(const Snapshot& now, std::uint32_t robot, std::size_t slot) const {
    if (timing_.latency_std_s == 0) return timing_.latency_s;
    Rng rng(now.seed, RandomPurpose::sensor_noise, robot, static_cast<std::uint32_t>(slot), now.time.step);
    rng.skipToBlock(static_cast<std::uint32_t>(beams_.size()));
    const double normal = rng.gaussian();
    const bool is_in_tail = timing_.latency_tail > 0 && rng.uniform() < timing_.latency_tail;
    const double std_s = timing_.latency_std_s * (is_in_tail ? timing_.latency_tail_factor : 1);
    return std::max(0.0, timing_.latency_s + std_s * normal);
  }

  void castSwept(const Snapshot& now, std::uint32_t robot, double latency_s, double pan_rad, BeamHits& hits) const {
    const PlanarTransform pan(PlanarTransform(), pan_rad);
    const double period_s = now.time.period_s;
    const std::size_t last = beams_.size() - 1;
    const double step_s = last > 0 ? timing_.sweep_s / static_cast<double>(last) : 0;
    const double sweep_s = step_s * static_cast<double>(last);
    const double oldest = (latency_s + sweep_s + timing_.interlace_s) / period_s;
    hits.moved.resize(beams_.size());
    const std::size_t revolutions = timing_.interlace_s > 0 ? 2 : 1;
    for (std::size_t revolution = 0; revolution < revolutions; ++revolution) {
      const double first = revolution == 0 ? oldest : (latency_s + sweep_s) / period_s;
      SweptPose pose(now.frames[robot], now.last_motion[robot], first, step_s / period_s);
      for (std::size_t i = 0; i <= last; ++i, pose.next()) {
        if (i % revolutions != revolution) continue;
        hits.moved[i] = {pose.pointToWorld(beams_[i].origin), pose.turnToWorld(pan.turnToWorld(beams_[i].direction))};
      }
    }
    const Motion& motion = now.last_motion[robot];
    const double turn_rad = std::abs(motion.turn_rad) * oldest * (1 + kSlack);
    const auto hit = [&](std::size_t i, double distance_m, BodyId body) { hits.set(i, distance_m, body); };
    if (turn_rad <= 1) {
      // A mount is displaced by the motion and by the turn of its arm.
      const double arm_m = portable::hypot(beams_[0].origin.x, beams_[0].origin.y);
      const double shift_m = (std::abs(motion.length_m) * oldest + arm_m * turn_rad) * (1 + kSlack);
      return beams_.castMoved(now, robot, pan_rad, info_.range_max_m,
                              {.rays = hits.moved, .shift_m = shift_m, .turn_rad = turn_rad}, hit);
    }
    for (std::size_t i = 0; i <= last; ++i) {
      const Hit found = now.scene.castRay(hits.moved[i], info_.range_max_m, now.bodyOf(robot));
      if (found) hit(i, found.distance_m, found.body);
    }
  }

  void applyErrors(const Snapshot& now, std::uint32_t robot, std::size_t slot, double drift_m, BeamHits& hits) const {
    static thread_local RandomBlocks random;
    static thread_local std::vector<double> read_m;
    const auto item = static_cast<std::uint32_t>(slot);
    random.draw(now.seed, RandomPurpose::sensor_noise, robot, item, now.time.step, beams_.size());
    const Ziggurat& ziggurat = Ziggurat::instance();
    const BeamFootprint footprint(now, errors_);
    read_m.resize(beams_.size());
    for (std::size_t i = 0; i < beams_.size(); ++i) {
      // A number that requires more random bits has 2^16 blocks of its own.
      const auto gaussian = [&](std::uint32_t word, std::uint32_t number) {
        return ziggurat.gaussian(word, [&] {
          Rng rng(now.seed, RandomPurpose::sensor_retry, robot, item, now.time.step);
          rng.skipToBlock(static_cast<std::uint32_t>(2 * i + number) << 16);
          return rng;
        });
      };
      BeamDraw draw{.event = random.words[0][i] * kUnit, .other = (random.words[1][i] + 0.5) * kUnit};
      Return echo{hits.distance_m[i]};
      if (is_lit_) {
        if (errors_.divergence_rad > 0) draw.distortion = gaussian(random.words[3][i], 1);
        echo = footprint.computeReturn(hits, i, draw.distortion);
      }
      if (!(echo.range_m < info_.range_max_m)) {
        read_m[i] = kNoHit_m;
        continue;
      }
      draw.gaussian = gaussian(random.words[2][i], 0);
      read_m[i] = process_.readingOf(echo.range_m, echo.power, drift_m, draw);
    }
    hits.distance_m.swap(read_m);
  }

  SensorInfo info_;
  LaserErrors errors_;
  ErrorProcess process_;
  LaserTiming timing_;
  PlanarBeams beams_;
  BeamFields fields_;
  bool has_errors_ = !(errors_ == LaserErrors());
  bool is_lit_ = errors_.divergence_rad > 0 || errors_.reach_m > 0;  ///< the returned light matters
};

}  // namespace

std::unique_ptr<Sensor> makeLaserScanner(const SensorInfo& info, const LaserErrors& errors, const LaserTiming& timing) {
  return std::make_unique<LaserScanner>(info, errors, timing);
}

}  // namespace robosim
