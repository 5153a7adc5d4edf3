#include "calibration/matched_scans.h"

#include <cmath>
#include <csignal>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/interrupt.h"
#include "base/random.h"
#include "calibration/laser_fit.h"
#include "calibration/map_residuals.h"
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
  ScanSeries series{.label = "laser", .step_rad = kRadPerDeg, .first_rad = -M_PI / 2, .range_max_m = 20, .scans = {}};
  Rng rng(2);
  for (int k = 0; k < 20; ++k) {
    const mrpt::math::TPose2D pose(-1 + 0.1 * k, 0.05 * k, 0.03 * k);
    RecordedScan scan;
    scan.odometry = mrpt::math::TPose2D(-1 + 0.11 * k, 0.05 * k, 0.032 * k);
    for (int i = 0; i < 181; ++i) scan.ranges_m.push_back(wallOf(pose, toRadians(i - 90)) + std_m * rng.gaussian());
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

TEST(MapResiduals, BoundTheNoiseOfTheScannerFromAbove) {
  constexpr double kStd_m = 0.01;
  const MatchedReadings matched = matchScans(drivingSeries(kStd_m), MapRange::mean);
  ASSERT_EQ(matched.first_of_scan.size(), 19u);
  const LaserFit fit = fitResiduals(computeResiduals(matched.readings), 0);
  // Variance of a point between two others: 2/3 on average; of the mean of three surfaces 2/9, of those before the
  // first two scans 2/3 and 1/3. (17 · 2/9 + 2/3 + 1/3) / 19 = 0.25, so √1.25 = 1.118 times the noise of the reading.
  // Some 1000 readings in each band: standard error 2.2 %.
  for (const std::size_t band : {1u, 2u}) EXPECT_NEAR(fit.std_m[band], 1.118 * kStd_m, 0.07 * kStd_m) << band;
  EXPECT_EQ(fit.errors.outlier, 0);
  EXPECT_EQ(fit.errors.dropout, 0);
}

TEST(MapResiduals, AreSimulatedWithTheErrorsOfTheScanner) {
  const std::vector<ExpectedReading> readings(1000, {0, 3});
  LaserErrors errors;
  errors.std_m = 0.02;
  errors.dropout = 0.1;
  errors.outlier = 0.05;
  const PairStatistics simulated = simulateResiduals(readings, errors, kJump_m, 20, 10, 1);
  EXPECT_EQ(simulated.beams, 10'000u);
  EXPECT_NEAR(simulated.flipRate(), 0.1, 0.012) << "four standard errors";
  // 5 % of all are 5.56 % of those with an echo, and 1.5 % of the outliers are within 15 cm.
  EXPECT_NEAR(simulated.jumpRate(), 0.0547, 0.0096) << "four standard errors";
  const LaserFit fit = fitResiduals(simulated, 0);
  EXPECT_NEAR(fit.std_m[1], 0.02, 0.0008);
  EXPECT_NEAR(fit.errors.dropout, 0.1, 0.012);
}

TEST(MapResiduals, AreThoseOfEveryOtherScan) {
  MatchedReadings matched;
  matched.readings = {{1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}};
  matched.first_of_scan = {0, 2, 2, 4};
  const auto readOf = [&](std::size_t first) {
    std::vector<double> read_m;
    for (const auto& reading : readingsOfScans(matched, first, 2)) read_m.push_back(reading.read_m);
    return read_m;
  };
  EXPECT_EQ(readOf(0), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(readOf(1), (std::vector<double>{5}));
}

TEST(MatchedScans, EndWhenASignalRequestsIt) {
  const ScanSeries series = drivingSeries(0.01);
  {
    const Interrupt interrupt;
    std::raise(SIGINT);
    EXPECT_THROW(matchScans(series), Interrupted);
    EXPECT_THROW(fitLaser(computeStatistics(series, {{.first = 0}}), 0), Interrupted);
    EXPECT_THROW(simulatePairs(series, {{.first = 0}}, {}, {}, kJump_m, 1, 1), Interrupted);
    EXPECT_THROW(fitBeamModel({{1, 1}}, 20), Interrupted);
  }
  const Interrupt withdrawn;
  EXPECT_EQ(matchScans(series).matched, 19u);
}

}  // namespace
}  // namespace robosim
