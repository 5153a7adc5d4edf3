#include "calibration/simulated_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/interrupt.h"
#include "sensors/beam_mounts.h"
#include "sensors/laser_scanner.h"

namespace robosim {
namespace {

/// Depth of the walls, and the robot's radius [m].
constexpr double kDepth_m = 0.01;
/// Width of a wall, as a share of the distance between adjacent beams.
constexpr double kWidth = 0.9;

/// Share of the echoes that the surface returns such that the share v of valid readings gives 2 v (1 − v) changes,
/// because readings are independent in the simulation.
double computeShare(const SeenSurface& seen, double dropout) {
  const double off_half = std::sqrt(std::max(0.0, 0.25 - seen.flips / 2));
  const double valid = seen.valid > 0.5 ? 0.5 + off_half : 0.5 - off_half;
  return std::min(1.0, valid / (1 - dropout));
}

/// Reflectivity at which a share of the echoes from a range is detected; the inverse of the model of LaserErrors.
double reflectivityOf(const LaserErrors& errors, double range_m, double share) {
  constexpr double kSteady = 1e-9;  // lost echoes of a beam that lost none
  const double odds = share < 1 - kSteady ? share / (1 - share) : 1 / kSteady;
  return std::min(1.0, std::pow(odds, errors.fading) * std::pow(range_m / errors.reach_m, 2));
}

Solid wallFor(double bearing_rad, double range_m, double step_rad) {
  const double middle_m = range_m + kDepth_m / 2;
  const mrpt::math::TPose2D pose(middle_m * std::cos(bearing_rad), middle_m * std::sin(bearing_rad), bearing_rad);
  return {OrientedBox::from(pose, kDepth_m, 2 * range_m * std::tan(kWidth * step_rad / 2)), {0, 1}};
}

/// The scanner at the origin among the walls.
class StandingScanner {
 public:
  StandingScanner(const ScanSeries& series, const std::vector<SeenSurface>& seen, const LaserErrors& errors,
                  std::uint64_t seed)
      : seed_(seed), scene_(makeWalls(series, seen, errors), 1, {-1, 1, -1, 1}) {
    double farthest_m = series.range_max_m;
    for (const auto& surface : seen) farthest_m = std::max(farthest_m, surface.range_m + 1);
    SensorInfo info{.kind = SensorKind::laser, .label = series.label, .beams = {}};
    for (std::size_t i = 0; i < seen.size(); ++i) info.beams.push_back(planarBeam(0, 0, 0.5, bearingOf(series, i)));
    info.range_max_m = info.no_echo_m = farthest_m;
    scanner_ = makeLaserScanner(info, errors, {});
    readings_[0].measurements.push_back(scanner_->blank());
    scene_.place(0, {Circle{{0, 0}, kDepth_m}, {0, 1}});
    scene_.freeze();
  }

  std::vector<double> scan() {
    const mrpt::math::TPose2D pose;
    const PlanarTransform frame(pose, 0);
    const Motion motion;
    const float pan_rad = 0;
    const std::uint32_t robot = 0;
    ++time_.step;
    const Snapshot now{.scene = scene_,
                       .heat_sources = {},
                       .world_from_robot = {&pose, 1},
                       .frames = {&frame, 1},
                       .last_motion = {&motion, 1},
                       .laser_pan_rad = {&pan_rad, 1},
                       .time = time_,
                       .seed = seed_,
                       .reflectivity = reflectivity_};
    scanner_->sense(now, {&robot, 1}, 0, readings_);
    std::vector<double> ranges_m;
    for (const auto& echo : std::get<Echoes>(readings_[0].measurements[0])) {
      const bool is_valid = echo.range_m < static_cast<float>(scanner_->info().no_echo_m);
      ranges_m.push_back(is_valid ? static_cast<double>(echo.range_m) : std::numeric_limits<double>::quiet_NaN());
    }
    return ranges_m;
  }

 private:
  static double bearingOf(const ScanSeries& series, std::size_t beam) {
    return series.first_rad + series.step_rad * static_cast<double>(beam);
  }

  std::vector<Solid> makeWalls(const ScanSeries& series, const std::vector<SeenSurface>& seen,
                               const LaserErrors& errors) {
    std::vector<Solid> walls;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (seen[i].range_m <= 0) continue;
      walls.push_back(wallFor(bearingOf(series, i), seen[i].range_m, series.step_rad));
      reflectivity_.push_back(static_cast<float>(
          errors.reach_m > 0 ? reflectivityOf(errors, seen[i].range_m, computeShare(seen[i], errors.dropout))
                             : kReflectivity));
    }
    return walls;
  }

  std::uint64_t seed_;
  std::vector<float> reflectivity_;
  Scene scene_;
  std::unique_ptr<Sensor> scanner_;
  std::vector<Readings> readings_ = std::vector<Readings>(1);
  SimTime time_;
};

}  // namespace

std::vector<SeenSurface> seenSurfaces(const ScanSeries& series, const std::vector<ScanPair>& pairs,
                                      const LostEchoes& echoes, double jump_m) {
  const std::vector<std::size_t> scans = listScans(pairs);
  std::vector<SeenSurface> seen(series.scans.empty() ? 0 : series.scans.front().ranges_m.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    std::vector<double> valid_m;
    for (const std::size_t scan : scans) {
      const double range_m = series.scans[scan].ranges_m[i];
      if (!std::isnan(range_m)) valid_m.push_back(range_m);
    }
    for (const auto& pair : pairs) {
      const bool is_first = !std::isnan(series.scans[pair.first].ranges_m[i]);
      const bool is_second = !std::isnan(series.scans[pair.first + 1].ranges_m[i]);
      if (is_first != is_second) seen[i].flips += 1 / static_cast<double>(pairs.size());
    }
    if (valid_m.empty()) continue;
    seen[i].valid = static_cast<double>(valid_m.size()) / static_cast<double>(scans.size());
    std::sort(valid_m.begin(), valid_m.end());
    const double median_m = valid_m[valid_m.size() / 2];
    double sum_m = 0;
    int near = 0;
    for (const double range_m : valid_m) {
      if (std::abs(range_m - median_m) > jump_m) continue;
      sum_m += range_m;
      ++near;
    }
    seen[i].range_m = sum_m / near;
    const std::size_t lost = scans.size() - valid_m.size();
    if (lost > 0 && echoes.isSteady(lost, scans.size())) {
      seen[i].valid = 1;
      seen[i].flips = 0;
    }
  }
  return seen;
}

PairStatistics simulatePairs(const ScanSeries& series, const std::vector<ScanPair>& pairs, const LaserErrors& errors,
                             const LostEchoes& echoes, double jump_m, std::size_t count, std::uint64_t seed) {
  PairStatistics statistics{.jump_m = jump_m};
  for (const auto& group : standingGroups(series, pairs)) {
    const auto seen = seenSurfaces(series, group, echoes, jump_m);
    std::vector<double> range_m;
    for (const auto& surface : seen) range_m.push_back(surface.range_m);
    StandingScanner scanner(series, seen, errors, seed++);
    for (std::size_t i = 0; i < count * group.size(); ++i) {
      throwIfInterrupted("nothing was written");
      const auto first = scanner.scan();
      statistics.add(first, scanner.scan(), range_m);
    }
  }
  return statistics;
}

}  // namespace robosim
