#pragma once
#include <array>

#include "calibration/pair_statistics.h"
#include "sensors/laser_errors.h"

namespace robosim {

/// Errors of a scanner, estimated from pairs of scans at rest.
struct LaserFit {
  LaserErrors errors;                  ///< Gaussian part by range with tail, quantum, lost echoes and outliers
  std::array<double, kBands> std_m{};  ///< Gaussian part by band; 0 for a band with fewer than kFewestDifferences
};

/// Fewest differences of a band from which a standard deviation is estimated.
constexpr std::size_t kFewestDifferences = 30;

/// Estimates errors by maximum likelihood of the differences, which are binned to the quantum (1 mm without one). The
/// error of a reading has the density (1 − t) N(0, σ²) + t N(0, (kσ)²), with σ of the band and common t (tail) and k
/// (tail_factor), which are searched on a grid; readings are rounded to the quantum after a uniform phase. The rate of
/// outliers is half of that of jumps, because each affects two differences. Lost echoes depend on the beam and are
/// estimated by dropoutOf(); dropout is 0 here.
/// @throws ConfigError without a band of kFewestDifferences
/// @throws Interrupted when a signal requests the end
LaserFit fitLaser(const PairStatistics& statistics, double quantum_m);

/// The same for residuals of single readings about the ranges that a map predicts (residualsOf(), map_residuals.h).
/// The rate of outliers is that of jumps, and dropout the share of readings without an echo. All errors are upper
/// bounds of the scanner's own, because the residuals also contain errors of the motion and of the map.
LaserFit fitResiduals(const PairStatistics& residuals, double quantum_m);

}  // namespace robosim
