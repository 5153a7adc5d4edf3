#pragma once
#include <cstddef>
#include <vector>

#include "calibration/laser_fit.h"
#include "calibration/pair_statistics.h"
#include "calibration/standing_scans.h"

namespace robosim {

/// Differences of a rate up to this are accepted, however many data there are.
constexpr double kRateTolerance = 0.003;

/// One half of a two-fold cross-validation: a model estimated from every other pair of scans at rest, or from every
/// other scan of a drive, and compared with the others.
struct HeldOutFit {
  std::vector<ScanPair> fitted, held_out;  ///< empty for FitBasis::local_map
  LaserFit model;
  PairStatistics real, simulated;  ///< of the held-out pairs or scans, and of the model

  /// Bound of the Kolmogorov–Smirnov distance of a band, at a level of 1 % for this band alone.
  double computeKsBound(std::size_t band) const;
  /// Bounds of the difference of the rates of jumps and of changes of validity: those that equal rates exceed with
  /// probability `level`, at least kRateTolerance. The pairs of one half share no scan and are independent.
  double jumpBound(double level) const;
  double flipBound(double level) const;
};

/// Whether the difference of a rate exceeds its bound.
///@{
bool isJumpRateBeyond(const HeldOutFit& half, double level);
bool isFlipRateBeyond(const HeldOutFit& half, double level);
///@}

}  // namespace robosim
