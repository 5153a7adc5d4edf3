#pragma once
#include <cstdint>
#include <string>

#include "base/interrupt.h"
#include "calibration/beam_model.h"
#include "calibration/laser_fit.h"
#include "calibration/pair_statistics.h"
#include "calibration/standing_scans.h"

namespace robosim {

/// By what a robot is known to stand.
enum class RestCriterion {
  scans,     ///< unchanged odometry, and scans that do not contradict it
  odometry,  ///< unchanged odometry only: also counts a robot that rocks
};

/// A model of a scanner, estimated from every other pair of scans at rest, and compared with the other pairs.
struct ScannerFit {
  ScanSeries series;
  RestCriterion criterion = RestCriterion::scans;
  std::vector<ScanPair> candidates;  ///< all pairs at unchanged odometry
  std::vector<ScanPair> fitted, held_out;
  LaserFit model;
  PairStatistics fitted_statistics, held_out_statistics, simulated;
  BeamModel beam_model;  ///< of all readings at rest, about the mean range of each beam

  /// Kolmogorov–Smirnov distance of the dequantised differences of a band, held out against simulated.
  double ksOf(std::size_t band) const;
  double ksBoundOf(std::size_t band) const;
  /// Whether all bands with held-out differences are within their bounds, and the rates of jumps and of changes of
  /// validity within 0.3 percentage points.
  bool isAccepted() const;
};

/// Largest accepted difference of a rate.
constexpr double kRateTolerance = 0.003;

/// @throws ConfigError when the file is no rawlog, has no such scanner, or the scanner is never at rest
/// @throws Interrupted when a signal requests the end
ScannerFit fitScanner(const std::string& rawlog, const std::string& sensor, RestCriterion criterion);

/// The fitted errors as a <laser> element's <noise>, with a comment on its origin: an XML document.
std::string modelXml(const ScannerFit& fit, const std::string& rawlog);
/// The results as a text table.
std::string summaryOf(const ScannerFit& fit);
/// The results with histograms, as one HTML page without external references.
std::string reportHtml(const ScannerFit& fit, const std::string& rawlog);

}  // namespace robosim
