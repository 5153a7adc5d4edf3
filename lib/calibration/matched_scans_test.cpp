#include "calibration/matched_scans.h"

#include <cmath>
#include <csignal>

#include <gtest/gtest.h>

#include "base/interrupt.h"
#include "base/random.h"
#include "calibration/laser_fit.h"
#include "calibration/simulated_pairs.h"

namespace robosim {
namespace {

/// Range from a pose inside a room of 8 m × 6 m about the origin.
double wallOf(const mrpt::math::TPose2D& pose, double bearing_rad) {
  const double x = std::cos(pose.phi + bearing_rad), y = std::sin(pose.phi + bearing_rad);
  const double to_x = x > 0 ? (4 - pose.x) / x : x < 0 ? (-4 - pose.x) / x : 1e9;
  const double to_y = y > 0 ? (3 - pose.y) / y : y < 0 ? (-3 - pose.y) / y : 1e9;
  return std::min(to_x, to_y);
}

/// Twenty scans with noise of `std_m`, from a robot that drives with odometry 10 % too long.
ScanSeries drivingSeries(double std_m) {
  ScanSeries series{.label = "laser", .step_rad = M_PI / 180, .first_rad = -M_PI / 2, .range_max_m = 20, .scans = {}};
  Rng rng(2);
  for (int k = 0; k < 20; ++k) {
    const mrpt::math::TPose2D pose(-1 + 0.1 * k, 0.05 * k, 0.03 * k);
    RecordedScan scan;
    scan.odometry = mrpt::math::TPose2D(-1 + 0.11 * k, 0.05 * k, 0.032 * k);
    for (int i = 0; i < 181; ++i) scan.ranges_m.push_back(wallOf(pose, (i - 90) * M_PI / 180) + std_m * rng.gaussian());
    series.scans.push_back(std::move(scan));
  }
  return series;
}

TEST(MatchedScans, HaveTheNoiseOfTheScannerAsResidualDespiteWrongOdometry) {
  constexpr double kStd_m = 0.01;
  const MatchedReadings matched = matchScans(drivingSeries(kStd_m));
  EXPECT_EQ(matched.matched, 19u);
  EXPECT_EQ(matched.failed, 0u);
  EXPECT_GT(matched.readings.size(), 3000u);
  const BeamModel model = fitBeamModel(matched.readings, 20);
  EXPECT_GT(model.z_hit, 0.95);
  // Noise of the reading and of the map, which consists of points with the same noise; the nearest of three surfaces.
  EXPECT_GT(model.sigma_hit_m, kStd_m);
  EXPECT_LT(model.sigma_hit_m, 2 * kStd_m);
}

TEST(MatchedScans, EndWhenASignalRequestsIt) {
  const ScanSeries series = drivingSeries(0.01);
  {
    const Interrupt interrupt;
    std::raise(SIGINT);
    EXPECT_THROW(matchScans(series), Interrupted);
    EXPECT_THROW(fitLaser(statisticsOf(series, {{.first = 0}}), 0), Interrupted);
    EXPECT_THROW(simulatePairs(series, {{.first = 0}}, {}, 1, 1), Interrupted);
    EXPECT_THROW(fitBeamModel({{1, 1}}, 20), Interrupted);
  }
  const Interrupt withdrawn;
  EXPECT_EQ(matchScans(series).matched, 19u);
}

}  // namespace
}  // namespace robosim
