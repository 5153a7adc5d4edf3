#pragma once
#include <array>
#include <vector>

#include "calibration/standing_scans.h"

namespace robosim {

/// Limits of the bands of range [m] in which differences are compared; the last band has no upper limit.
inline constexpr std::array kBandLimits_m{0.0, 2.0, 4.0, 6.0, 8.0};
inline constexpr std::size_t kBands = kBandLimits_m.size();
/// Differences [m] above this, or above six robust standard deviations if that is more, are jumps: computeJumpLimit().
inline constexpr double kJump_m = 0.15;

std::size_t findBand(double range_m);
/// "2 … 4 m", "> 8 m".
const char* bandName(std::size_t band);

/// The pair and the beam of a difference: differences of one beam, and those of pairs that share a scan, are dependent.
struct DifferenceOrigin {
  std::uint32_t pair = 0, beam = 0;
};

/// Differences of pairs of scans of the same scene.
struct PairStatistics {
  double jump_m = kJump_m;  ///< larger differences are jumps
  std::size_t pairs = 0;
  /// Second minus first range, without jumps, by the range of the beam.
  std::array<std::vector<double>, kBands> differences_m{};
  std::array<std::vector<DifferenceOrigin>, kBands> origins{};  ///< of these, in their order
  std::vector<DifferenceOrigin> jump_origins{};
  std::size_t compared = 0;   ///< beams that are valid in both scans of a pair
  std::size_t jumps = 0;      ///< of these, differences above jump_m
  std::size_t beams = 0;      ///< all beams of all pairs
  std::size_t flips = 0;      ///< of these, valid in one scan only
  std::size_t invalid = 0;    ///< of these, invalid in both scans
  double outlier_window = 0;  ///< sum of the shares of uniform outliers that are no jump, of the differences
  double range_max_m = 0;     ///< of the scanner, for outlier_window; 0: unknown

  /// @param range_m by beam: the range that tells the band; empty: the mean of both readings
  void add(const std::vector<double>& first_m, const std::vector<double>& second_m,
           const std::vector<double>& range_m = {});
  void add(const PairStatistics& other);
  std::size_t differences() const { return compared - jumps; }
  double jumpRate() const { return compared ? static_cast<double>(jumps) / static_cast<double>(compared) : 0; }
  double flipRate() const { return beams ? static_cast<double>(flips) / static_cast<double>(beams) : 0; }
  double invalidRate() const { return beams ? static_cast<double>(invalid) / static_cast<double>(beams) : 0; }
};

/// Statistics of pairs of scans at rest, with bands by the median range of each beam at its place.
PairStatistics computeStatistics(const ScanSeries& series, const std::vector<ScanPair>& pairs, double jump_m = kJump_m);

/// Limit above which a difference is a jump: kJump_m, or six times the robust standard deviation of the differences
/// (1.4826 times the median of their absolute values) if that is more, so that it is no part of the noise. Between two
/// multiples of the quantum.
double computeJumpLimit(std::vector<double> differences_m, double quantum_m);
double computeJumpLimit(const ScanSeries& series, const std::vector<ScanPair>& pairs, double quantum_m);

/// Each difference of multiples of a quantum plus a number that is uniform within ±quantum / 2, from fixed random
/// numbers, so that two samples can be compared as continuous ones.
std::vector<double> dequantised(std::vector<double> differences_m, double quantum_m, std::uint64_t seed);

/// Two-sample Kolmogorov–Smirnov distance: the largest difference of the empirical distribution functions. 1 for an
/// empty sample.
double ksDistance(std::vector<double> a, std::vector<double> b);
/// The distance that equal distributions exceed with probability `level`: √(-ln(level / 2) / 2 · (1/n + 1/m)), at least
/// 0.05.
double ksBound(std::size_t n, std::size_t m, double level = 0.01);

/// The largest q such that nearly all ranges are multiples of q, of 1 mm … 1 m; 0 for none.
double estimateQuantum(const ScanSeries& series);

}  // namespace robosim
