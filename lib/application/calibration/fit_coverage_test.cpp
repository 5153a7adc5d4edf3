// Fits of simulated scanners of known parameters: with three seeds, or with ROBOSIM_VERIFY seeds (tests/verify/fit.sh).
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/text_table.h"
#include "calibration/scanner_fit.h"

namespace robosim {
namespace {

struct Scanner {
  double std_m = 0.01, dropout = 0.01, time_s = 30;
  double reach_m = 0;    ///< 0: every surface is detected
  double quantum_m = 0;  ///< 0: any range
};

constexpr int kScannerBeams = 31;
constexpr double kScannerRange_m = 20, kScannerOutlier = 0.01, kScannerFading = 0.1;

double surfaceAt(int beam) { return 1.013 + 0.2477 * beam; }

/// Scans at 10 Hz of surfaces at 1 m … 8.4 m that return half of the light.
ScanSeries scansOfScanner(const Scanner& scanner, std::uint64_t seed) {
  LaserErrors errors{.std_m = scanner.std_m,
                     .std_at = {},
                     .quantum_m = scanner.quantum_m,
                     .dropout = scanner.dropout,
                     .outlier = kScannerOutlier,
                     .reach_m = scanner.reach_m,
                     .fading = kScannerFading};
  SensorInfo info{.kind = SensorKind::laser, .label = "", .beams = {}};
  info.range_max_m = kScannerRange_m;
  const ErrorProcess process(errors, info);
  ScanSeries series{
      .label = "laser", .step_rad = 0.03, .first_rad = -0.45, .range_max_m = kScannerRange_m, .scans = {}};
  Rng rng(seed);
  for (int k = 0; k <= std::lround(10 * scanner.time_s); ++k) {
    RecordedScan scan{.time_s = 0.1 * k, .ranges_m = {}, .odometry = mrpt::math::TPose2D()};
    for (int i = 0; i < kScannerBeams; ++i) {
      const BeamDraw draw{.event = rng.uniform(), .other = rng.uniform(), .gaussian = rng.gaussian()};
      const double power = 0.5 * std::pow(scanner.reach_m / surfaceAt(i), 2);
      const double read_m = process.readingOf(surfaceAt(i), scanner.reach_m > 0 ? power : 1e9, 0, draw);
      scan.ranges_m.push_back(read_m < kScannerRange_m ? read_m : std::numeric_limits<double>::quiet_NaN());
    }
    series.scans.push_back(std::move(scan));
  }
  return series;
}

struct Coverage {
  int parameters = 0, covered = 0;
  void add(const ConfidenceInterval& interval, double truth) {
    ++parameters;
    covered += interval.contains(truth);
  }
  std::string text() const { return parameters ? fixed(100.0 * covered / parameters, 1) : "–"; }
};

TEST(FitCoverage, IntervalsContainTheParametersAndTheTrueModelIsNotRejected) {
  const char* const verify = std::getenv("ROBOSIM_VERIFY");
  const int seeds = verify ? std::max(20, std::atoi(verify)) : 3;
  const std::vector<Scanner> few{{.time_s = 10}, {.std_m = 0.3, .dropout = 0.05, .time_s = 10}};
  const std::vector<Scanner> many{{.time_s = 10},
                                  {.time_s = 30},
                                  {.time_s = 300},
                                  {.std_m = 0.05},
                                  {.std_m = 0.1},
                                  {.std_m = 0.3, .time_s = 10},
                                  {.std_m = 0.3},
                                  {.std_m = 0.3, .time_s = 300},
                                  {.dropout = 0.001},
                                  {.dropout = 0.05},
                                  {.dropout = 0.05, .time_s = 300},
                                  {.std_m = 0.1, .dropout = 0.001, .time_s = 10},
                                  {.reach_m = 10},
                                  {.time_s = 300, .reach_m = 10},
                                  {.std_m = 0.1, .reach_m = 10},
                                  {.std_m = 0.005, .quantum_m = 0.01}};
  Rows rows{
      {"σ [m]", "lost [%]", "time [s]", "reach [m]", "σ", "tail", "dropout", "outlier", "reach", "all", "rejected"}};
  Coverage total;
  int rejected = 0, fits = 0;
  Progress progress;
  for (const auto& scanner : verify ? many : few) {
    Coverage std_m, tail, dropout, outlier, reach, all;
    int rejected_here = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const ScannerFit fit = fitScans(scansOfScanner(scanner, static_cast<std::uint64_t>(seed)), RestCriterion::scans,
                                      "simulated", progress);
      for (std::size_t band = 0; band < kBands; ++band) {
        if (fit.model.std_m[band] > 0) std_m.add(fit.model.std_interval_m[band], scanner.std_m);
      }
      tail.add(fit.model.tail, 0);
      dropout.add(fit.model.dropout, scanner.dropout);
      outlier.add(fit.model.outlier, kScannerOutlier);
      if (scanner.reach_m > 0) reach.add(fit.model.reach_m, scanner.reach_m);
      if (scanner.reach_m == 0) {
        EXPECT_EQ(fit.model.errors.reach_m, 0) << "seed " << seed;
      }
      rejected_here += !fit.isAccepted();
    }
    for (const auto* part : {&std_m, &tail, &dropout, &outlier, &reach}) {
      all.parameters += part->parameters;
      all.covered += part->covered;
    }
    total.parameters += all.parameters;
    total.covered += all.covered;
    rejected += rejected_here;
    fits += seeds;
    rows.push_back({fixed(scanner.std_m, 3), fixed(100 * scanner.dropout, 1), fixed(scanner.time_s, 0),
                    fixed(scanner.reach_m, 0), std_m.text(), tail.text(), dropout.text(), outlier.text(), reach.text(),
                    all.text(), std::to_string(rejected_here) + " of " + std::to_string(seeds)});
    if (verify) {
      EXPECT_LE(rejected_here, seeds / 20) << rows.back()[0];
    }
  }
  if (verify) std::cout << table(rows) << "all: " << total.text() << " % of " << total.parameters << '\n';
  // Of at least 40 parameters at 95 %, more than 7 are missed with a probability below 0.2 %.
  EXPECT_GE(total.covered, verify ? 0.95 * total.parameters : total.parameters - 7);
  EXPECT_LE(rejected, verify ? fits / 20 : 0);
}

}  // namespace
}  // namespace robosim
