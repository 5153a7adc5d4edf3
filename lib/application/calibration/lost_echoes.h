#pragma once
#include <cstddef>
#include <vector>

#include "calibration/confidence.h"
#include "calibration/standing_scans.h"

namespace robosim {

/// Lost echoes of a scanner at rest: each beam is steady and loses echoes at a common rate, or flickers, because its
/// surface is at the limit of detection, so that any number of losses is equally likely.
struct LostEchoes {
  double dropout = 0;  ///< common rate of the steady beams
  ConfidenceInterval interval{0, 1};
  double flickering = 0;  ///< share of the beams; 0 unless the likelihood rejects this at a level of 0.1 %
  double reach_m = 0;     ///< 0 if no beam flickers: the recording does not bound it
  ConfidenceInterval reach;
  double farthest_m = 0;  ///< the largest range of a beam with echoes

  /// Whether a beam with so many lost echoes is rather steady than flickering.
  bool isSteady(std::size_t lost, std::size_t scans) const;
};

/// Estimates the mixture by expectation maximisation (Dempster, Laird & Rubin, 1977) from the beams with any echo.
/// Places with fewer than five scans are left out, because they do not distinguish the two kinds of beams.
///
/// The reach follows from the farthest flickering surface: half of its echoes are detected at its range if
/// reflectivity × cos(incidence) × (reach / range)² = 1, with 0.5, the default reflectivity of RoboSim, for the
/// estimate, and 1 … 0.1 for the interval; echoes from farther away raise it.
LostEchoes countLostEchoes(const ScanSeries& series, const std::vector<ScanPair>& pairs);

}  // namespace robosim
