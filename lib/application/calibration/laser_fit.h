#pragma once
#include <array>
#include <optional>

#include "calibration/confidence.h"
#include "calibration/pair_statistics.h"
#include "sensors/laser_errors.h"

namespace robosim {

/// Errors of a scanner, estimated from pairs of scans at rest, with intervals of 95 %.
struct LaserFit {
  LaserErrors errors;                  ///< Gaussian part by range with tail, quantum, lost echoes and outliers
  std::array<double, kBands> std_m{};  ///< Gaussian part by band; 0 for a band with fewer than kFewestDifferences
  std::array<ConfidenceInterval, kBands> std_interval_m{};
  ConfidenceInterval tail, tail_factor, dropout, outlier;
  /// Of errors.reach_m, if that is above 0: for surfaces whose reflectivity times the cosine of the angle of incidence
  /// is 1 … 0.1 (LostEchoes).
  ConfidenceInterval reach_m;
};

/// Fewest differences of a band from which a standard deviation is estimated.
constexpr std::size_t kFewestDifferences = 30;

/// Estimates errors by maximum likelihood of the differences (BinnedSample), a mixture of noise and uniform outliers.
/// The error of a reading has the density (1 − t) N(0, σ²) + t N(0, (kσ)²), with σ of the band and common t (tail) and
/// k (tail_factor), which are searched on a grid; t is 0 unless the likelihood rejects this at a level of 1 %.
/// Intervals of σ, t and k are those of the profile likelihood, widened by the design effect of differences that share
/// a beam or a scan. The rate of outliers is that of single readings: a difference is a jump if either of its readings
/// is an outlier beyond the limit of jumps. Lost echoes depend on the beam and are estimated by countLostEchoes();
/// dropout is 0 here.
/// @throws ConfigError without a band of kFewestDifferences
/// @throws Interrupted when a signal requests the end
LaserFit fitLaser(const PairStatistics& statistics, double quantum_m);

/// The same for residuals of single readings about the ranges that a map predicts (computeResiduals(),
/// map_residuals.h), with dropout as the share of readings without an echo. All errors are upper bounds of the
/// scanner's own, because the residuals also contain errors of the motion and of the map.
LaserFit fitResiduals(const PairStatistics& residuals, double quantum_m);

}  // namespace robosim
