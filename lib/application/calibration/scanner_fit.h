#pragma once
#include <cstdint>
#include <string>

#include "base/interrupt.h"
#include "base/progress.h"
#include "calibration/beam_model.h"
#include "calibration/cross_validation.h"
#include "calibration/laser_fit.h"
#include "calibration/lost_echoes.h"
#include "calibration/matched_scans.h"
#include "calibration/pair_statistics.h"
#include "calibration/standing_scans.h"

namespace robosim {

/// By what a robot is known to stand.
enum class RestCriterion {
  scans,     ///< unchanged odometry, and scans that do not contradict it
  odometry,  ///< unchanged odometry only: also counts a robot that rocks
};

/// What the errors are estimated from.
enum class FitBasis {
  scans_at_rest,  ///< differences of pairs of scans at rest
  /// Residuals of the scans of a drive about the local map, for a recording with fewer than kFewestPairs pairs at rest.
  /// They also contain errors of the motion and of the map.
  local_map,
};

/// A model of a scanner, estimated from all pairs of scans at rest, or from all scans of a drive. Two-fold
/// cross-validation (HeldOutFit) compares each pair or scan with a model that is not fitted to it.
struct ScannerFit {
  ScanSeries series;
  FitBasis basis = FitBasis::scans_at_rest;
  RestCriterion criterion = RestCriterion::scans;
  std::vector<ScanPair> candidates;  ///< all pairs at unchanged odometry
  std::vector<ScanPair> used;        ///< of these, by the criterion
  LaserFit model;                    ///< of all of them, or of all scans
  LostEchoes echoes;                 ///< of all of them; unless local_map
  std::array<HeldOutFit, 2> folds;   ///< fitted to the pairs (scans) of even and of odd number
  PairStatistics real, simulated;    ///< of both folds
  BeamModel beam_model;              ///< of all readings at rest, about the mean range of each beam; unless local_map
  MatchedReadings map_readings;
  BeamModel map_model;  ///< of these

  /// Kolmogorov–Smirnov distance of the dequantised differences of a band, held out against simulated.
  double computeKs(std::size_t band) const { return computeKs(real, simulated, band); }
  double computeKs(const PairStatistics& held_out, const PairStatistics& model, std::size_t band) const;
  double computeKsBound(std::size_t band) const;
  /// Whether the distance of one half of the pairs exceeds the bound of its own numbers of differences.
  bool isBeyondBound(const HeldOutFit& half, std::size_t band) const;
  /// Level of each comparison of the verdict: kVerdictLevel divided by their number (Bonferroni, 1936).
  double comparisonLevel() const;
  /// Whether all bands of both folds together are within their bounds, and the rates of each fold agree. A recording of
  /// the fitted model itself is rejected with a probability of at most kVerdictLevel.
  bool isAccepted() const;
};

constexpr double kVerdictLevel = 0.01;
/// Fewest pairs of scans at rest from which errors are estimated.
constexpr std::size_t kFewestPairs = 2;
/// Fewest aligned scans from which errors are estimated otherwise.
constexpr std::size_t kFewestMatchedScans = 10;

/// @throws ConfigError when the file is no rawlog, has no such scanner, or the scanner is never at rest and too few of
/// its scans can be aligned
/// @throws Interrupted when a signal requests the end
ScannerFit fitScanner(const std::string& rawlog, const std::string& sensor, RestCriterion criterion);

/// The same for scans that are read already. @param name of the recording, for messages
ScannerFit fitScans(ScanSeries series, RestCriterion criterion, const std::string& name, Progress& progress);

/// The fitted errors as a <laser> element's <noise>, with a comment on its origin: an XML document.
std::string modelXml(const ScannerFit& fit, const std::string& rawlog);
/// The results as a text table. "!" marks each figure that is beyond its bound; isAccepted() does not regard the KS
/// distances of one half.
std::string summaryOf(const ScannerFit& fit);
/// The results with histograms, as one HTML page without external references.
std::string reportHtml(const ScannerFit& fit, const std::string& rawlog);

}  // namespace robosim
