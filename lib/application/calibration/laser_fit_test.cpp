#include "calibration/laser_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "base/random.h"
#include "calibration/beam_model.h"
#include "calibration/scanner_fit.h"
#include "calibration/simulated_pairs.h"

namespace robosim {
namespace {

/// Scans of a scanner of 181 beams with these errors, in front of walls at 1 m … 10 m.
ScanSeries standingSeries(std::size_t scans, const LaserErrors& errors) {
  ScanSeries series{.label = "laser", .step_rad = kRadPerDeg, .first_rad = -M_PI / 2, .range_max_m = 30, .scans = {}};
  Rng rng(3);
  const ErrorProcess process(errors, {.kind = SensorKind::laser, .label = "", .beams = {}, .range_max_m = 30});
  for (std::size_t k = 0; k < scans; ++k) {
    RecordedScan scan{.time_s = 0.1 * static_cast<double>(k), .ranges_m = {}, .odometry = mrpt::math::TPose2D()};
    for (int i = 0; i < 181; ++i) {
      const BeamDraw draw{.event = rng.uniform(), .other = rng.uniform(), .gaussian = rng.gaussian()};
      scan.ranges_m.push_back(process.readingOf(1 + 0.05003 * i, 1, 0, draw));
    }
    series.scans.push_back(std::move(scan));
  }
  return series;
}

TEST(LaserFit, RecoversTheErrorsOfASimulatedScanner) {
  LaserErrors errors;
  errors.std_m = 0.006;
  errors.quantum_m = 0.01;
  errors.tail = 0.05;
  errors.tail_factor = 5;
  const ScanSeries series = standingSeries(200, errors);
  const LaserFit fit = fitLaser(computeStatistics(series, standingPairs(series)), estimateQuantum(series));
  EXPECT_DOUBLE_EQ(fit.errors.quantum_m, 0.01);
  for (std::size_t band = 0; band < kBands; ++band) EXPECT_NEAR(fit.std_m[band], 0.006, 0.0006) << bandName(band);
  EXPECT_NEAR(fit.errors.tail, 0.05, 0.03);
  EXPECT_NEAR(fit.errors.tail_factor, 5, 1.01);
}

TEST(LaserFit, RefusesTooFewDifferences) {
  PairStatistics few;
  few.add({1, 2}, {1, 2});
  EXPECT_THROW(fitLaser(few, 0), ConfigError);
}

/// Loses echoes of all beams at random.
void loseEchoes(ScanSeries& series, double share, std::size_t first_beam = 0, std::size_t last_beam = 180) {
  Rng rng(7);
  for (auto& scan : series.scans) {
    for (std::size_t i = first_beam; i <= last_beam; ++i) {
      if (rng.uniform() < share) scan.ranges_m[i] = std::nan("");
    }
  }
}

TEST(Dropout, IsTheShareOfLostEchoesOfSteadyBeams) {
  LaserErrors errors;
  errors.std_m = 0.005;
  ScanSeries series = standingSeries(200, errors);
  const auto pairs = standingPairs(series);
  EXPECT_EQ(countLostEchoes(series, pairs).dropout, 0);
  loseEchoes(series, 0.01);
  loseEchoes(series, 0.5, 0, 9);  // surfaces at the limit of detection
  // 171 steady beams: standard error √(0.01 / 34,200) = 0.00054.
  const LostEchoes echoes = countLostEchoes(series, pairs);
  EXPECT_NEAR(echoes.dropout, 0.01, 4 * 0.00054);
  EXPECT_TRUE(echoes.interval.contains(0.01));
  EXPECT_NEAR(echoes.flickering, 10.0 / 181, 0.01);
  errors.dropout = echoes.dropout;
  errors.reach_m = 100;
  errors.fading = 0.1;
  const double real = computeStatistics(series, pairs).flipRate();
  // (171 · 2 · 0.01 · 0.99 + 10 · 2 · 0.5 · 0.5) / 181; the losses of all scans are known, those of a pair vary.
  EXPECT_NEAR(real, 0.0463, 0.004);
  EXPECT_NEAR(simulatePairs(series, pairs, errors, echoes, kJump_m, 2, 1).flipRate(), real, 0.003);
}

TEST(Dropout, IsTheSameForALongRecording) {
  LaserErrors errors;
  errors.std_m = 0.01;
  // Of 1,810 to 181,000 readings; four standard errors.
  for (const std::size_t scans : {10u, 100u, 1000u}) {
    ScanSeries series = standingSeries(scans, errors);
    loseEchoes(series, 0.01);
    const LostEchoes echoes = countLostEchoes(series, standingPairs(series));
    EXPECT_NEAR(echoes.dropout, 0.01, 4 * std::sqrt(0.01 * 0.99 / (181 * static_cast<double>(scans)))) << scans;
    EXPECT_EQ(echoes.reach_m, 0) << "no beam flickers";
  }
}

/// A wide standard deviation is not cut off at a fixed limit, with outliers and without.
TEST(LaserFit, RecoversWideNoiseBesideOutliers) {
  for (const double std_m : {0.05, 0.1, 0.3}) {
    LaserErrors errors;
    errors.std_m = std_m;
    errors.outlier = 0.02;
    Progress progress;
    const ScannerFit fit = fitScans(standingSeries(100, errors), RestCriterion::scans, "simulated", progress);
    for (std::size_t band = 0; band < kBands; ++band) {
      // 20 to 60 beams, 100 scans: relative standard error 1/√4000 = 1.6 % of independent readings.
      EXPECT_NEAR(fit.model.std_m[band], std_m, 0.08 * std_m) << bandName(band);
      EXPECT_LE(fit.model.std_interval_m[band].low, std_m * 1.02) << bandName(band);
      EXPECT_GE(fit.model.std_interval_m[band].high, std_m * 0.98) << bandName(band);
    }
    EXPECT_EQ(fit.model.errors.tail, 0);
    // Of 18,100 readings: standard error 0.001.
    EXPECT_NEAR(fit.model.errors.outlier, 0.02, 4 * 0.001) << std_m;
    EXPECT_TRUE(fit.isAccepted()) << summaryOf(fit);
  }
}

TEST(ConfidenceInterval, OfAProbabilityIsThatOfClopperAndPearson) {
  // Without a hit in n trials: 1 − 0.025^(1/n).
  const ConfidenceInterval none = binomialInterval(0, 10);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 1 - std::pow(0.025, 0.1), 1e-9);
  const ConfidenceInterval all = binomialInterval(10, 10);
  EXPECT_NEAR(all.low, std::pow(0.025, 0.1), 1e-9);
  EXPECT_EQ(all.high, 1);
  EXPECT_NEAR(normalBound(0.05), 1.959964, 1e-6);
}

TEST(StandingPairs, ExcludeAPairThatTheRobotTurnedInBetween) {
  // Walls at a slope of 5 cm per beam; the second half of the scans is turned by half a beam.
  LaserErrors errors;
  errors.std_m = 0.005;
  ScanSeries series = standingSeries(20, errors);
  for (std::size_t k = 10; k < 20; ++k) {
    for (auto& range_m : series.scans[k].ranges_m) range_m += 0.025;
  }
  const auto pairs = standingPairs(series);
  ASSERT_EQ(pairs.size(), 19u);
  for (const auto& pair : pairs) EXPECT_EQ(pair.is_at_rest, pair.first != 9) << pair.first;
  EXPECT_NEAR(pairs[9].turned_rad, toRadians(0.5), toRadians(0.1));
}

TEST(PairStatistics, CountJumpsAndChangesOfValidity) {
  const double none = std::nan("");
  PairStatistics statistics;
  statistics.add({1, 3, 5, none, none, 7}, {1.01, 3.2, none, 2, none, 7});
  EXPECT_EQ(statistics.beams, 6u);
  EXPECT_EQ(statistics.compared, 3u);
  EXPECT_EQ(statistics.jumps, 1u);
  EXPECT_EQ(statistics.flips, 2u);
  EXPECT_EQ(statistics.invalid, 1u);
  ASSERT_EQ(statistics.differences_m[0].size(), 1u);
  EXPECT_NEAR(statistics.differences_m[0][0], 0.01, 1e-12);
  EXPECT_EQ(statistics.differences_m[3].size(), 1u);
}

TEST(KsDistance, IsTheLargestDifferenceOfTheDistributionFunctions) {
  EXPECT_DOUBLE_EQ(ksDistance({1, 2, 3, 4}, {1, 2, 3, 4}), 0);
  EXPECT_DOUBLE_EQ(ksDistance({1, 2, 3, 4}, {3, 4, 5, 6}), 0.5);
  EXPECT_DOUBLE_EQ(ksDistance({1, 1, 1}, {2, 2}), 1);
  EXPECT_DOUBLE_EQ(ksDistance({}, {2, 2}), 1);
  EXPECT_DOUBLE_EQ(ksBound(10000, 10000), 0.05);
  EXPECT_NEAR(ksBound(100, 100), std::sqrt(std::log(200) / 100), 1e-12);
}

TEST(BeamModel, RecoversTheWeightsOfASample) {
  Rng rng(5);
  std::vector<ExpectedReading> readings;
  for (int i = 0; i < 20000; ++i) {
    const double expected_m = rng.uniform(6, 9);
    const double part = rng.uniform();
    double read_m = expected_m + 0.02 * rng.gaussian();
    if (part < 0.05) {
      do read_m = -std::log(1 - rng.uniform()) / 1.5;
      while (read_m > expected_m);
    } else if (part < 0.08) {
      read_m = std::nan("");
    } else if (part < 0.10) {
      read_m = rng.uniform(0, 20);
    }
    readings.push_back({read_m, expected_m});
  }
  const BeamModel model = fitBeamModel(readings, 20);
  EXPECT_NEAR(model.z_hit, 0.90, 0.01);
  EXPECT_NEAR(model.z_short, 0.05, 0.01);
  EXPECT_NEAR(model.z_max, 0.03, 0.005);
  EXPECT_NEAR(model.z_rand, 0.02, 0.006);
  EXPECT_NEAR(model.sigma_hit_m, 0.02, 0.0006);
  EXPECT_NEAR(model.lambda_short_per_m, 1.5, 0.2);
}

}  // namespace
}  // namespace robosim
