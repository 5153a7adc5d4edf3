#include "sensors/laser_scanner.h"

#include <cmath>
#include <limits>

#include "base/portable_math.h"
#include "sensors/beam_echoes.h"
#include "sensors/beam_footprint.h"
#include "sensors/planar_beams.h"
#include "sensors/swept_pose.h"

namespace robosim {
namespace {

constexpr double kNoHit_m = std::numeric_limits<double>::infinity();

class LaserScanner : public Sensor {
 public:
  LaserScanner(const SensorInfo& info, const LaserErrors& errors, const LaserTiming& timing)
      : info_(info), errors_(errors), timing_(timing), beams_(info.beams) {
    for (std::size_t i = 0; i < beams_.size(); ++i) fields_.add(beams_[i]);
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return errors_.isRandom(); }
  bool sensesInHostProcess() const override { return timing_.rate_hz > 0; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    if (!timing_.isDue(now.time)) return;
    static thread_local BeamHits hits;  // reused for all robots of a thread
    const double drift_m = errors_.driftAt(now.time.seconds());
    for (const auto robot : robots) {
      const double pan_rad = info_.pans ? now.laser_pan_rad[robot] : 0;
      cast(now, robot, pan_rad, hits);
      applyErrors(now, robot, slot, drift_m, hits);
      setEchoes(fields_, info_, PlanarTransform(PlanarTransform(), pan_rad), hits.read_m,
                std::get<Echoes>(readings[robot].measurements[slot]));
    }
  }

 private:
  void cast(const Snapshot& now, std::uint32_t robot, double pan_rad, BeamHits& hits) const {
    hits.reset(beams_.size());
    const Motion& motion = now.last_motion[robot];
    const bool has_moved = motion.length_m != 0 || motion.turn_rad != 0;
    if (has_moved && (timing_.sweep_s > 0 || timing_.latency_s > 0)) return castSwept(now, robot, pan_rad, hits);
    beams_.cast(now, robot, pan_rad, info_.range_max_m, [&](std::size_t i, double distance_m, BodyId body) {
      if (body != kNoBody) hits.set(i, distance_m, body);
    });
    if (errors_.divergence_rad == 0 && errors_.reach_m == 0) return;
    const PlanarTransform pan(PlanarTransform(), pan_rad);
    for (std::size_t i = 0; i < beams_.size(); ++i) {
      hits.rays[i] = {now.frames[robot].pointToWorld(beams_[i].origin),
                      now.frames[robot].turnToWorld(pan.turnToWorld(beams_[i].direction))};
    }
  }

  void castSwept(const Snapshot& now, std::uint32_t robot, double pan_rad, BeamHits& hits) const {
    const PlanarTransform pan(PlanarTransform(), pan_rad);
    const double period_s = now.time.period_s;
    const std::size_t last = beams_.size() - 1;
    const double step_s = last > 0 ? timing_.sweep_s / static_cast<double>(last) : 0;
    SweptPose pose(now.frames[robot], now.last_motion[robot],
                   (timing_.latency_s + step_s * static_cast<double>(last)) / period_s, step_s / period_s);
    for (std::size_t i = 0; i <= last; ++i, pose.next()) {
      hits.rays[i] = {pose.pointToWorld(beams_[i].origin), pose.turnToWorld(pan.turnToWorld(beams_[i].direction))};
      const Hit hit = now.scene.castRay(hits.rays[i], info_.range_max_m, now.bodyOf(robot));
      if (hit) hits.set(i, hit.distance_m, hit.body);
    }
  }

  void applyErrors(const Snapshot& now, std::uint32_t robot, std::size_t slot, double drift_m, BeamHits& hits) const {
    Rng rng = now.noise(robot, slot);
    const BeamFootprint footprint(now, now.bodyOf(robot), errors_, info_.range_max_m);
    for (std::size_t i = 0; i < beams_.size(); ++i) {
      const BeamDraw draw(rng);  // also without a hit, so that a beam's errors do not depend on the others
      const Return echo = footprint.returnOf(hits, i, draw.gaussian[1]);
      hits.read_m[i] = echo.range_m < info_.range_max_m ? readingOf(errors_, echo.range_m, echo.power, drift_m,
                                                                    info_.range_min_m, info_.range_max_m, draw)
                                                        : kNoHit_m;
    }
  }

  SensorInfo info_;
  LaserErrors errors_;
  LaserTiming timing_;
  PlanarBeams beams_;
  BeamFields fields_;
};

}  // namespace

bool LaserTiming::isDue(const SimTime& now) const {
  if (rate_hz == 0 || now.step == 0) return true;
  constexpr double kTolerance = 1e-6;  // in scans; absorbs the rounding error of the time
  const auto scans = [&](std::uint64_t step) {
    return std::floor((static_cast<double>(step) * now.period_s - phase_s) * rate_hz + kTolerance);
  };
  return scans(now.step) > scans(now.step - 1);
}

std::unique_ptr<Sensor> makeLaserScanner(const SensorInfo& info, const LaserErrors& errors, const LaserTiming& timing) {
  return std::make_unique<LaserScanner>(info, errors, timing);
}

}  // namespace robosim
