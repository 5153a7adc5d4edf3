#pragma once
#include <array>
#include <vector>

#include "calibration/standing_scans.h"

namespace robosim {

/// Limits of the bands of range [m] in which differences are compared; the last band has no upper limit.
inline constexpr std::array kBandLimits_m{0.0, 2.0, 4.0, 6.0, 8.0};
inline constexpr std::size_t kBands = kBandLimits_m.size();
/// Larger differences [m] are jumps.
inline constexpr double kJump_m = 0.15;

std::size_t bandOf(double range_m);
/// "2 … 4 m", "> 8 m".
const char* bandName(std::size_t band);

/// Differences of pairs of scans of the same scene.
struct PairStatistics {
  std::size_t pairs = 0;
  std::array<std::vector<double>, kBands> differences_m;  ///< second minus first range, without jumps, by mean range
  std::size_t compared = 0;                               ///< beams that are valid in both scans of a pair
  std::size_t jumps = 0;                                  ///< of these, differences above kJump_m
  std::size_t beams = 0;                                  ///< all beams of all pairs
  std::size_t flips = 0;                                  ///< of these, valid in one scan only
  std::size_t invalid = 0;                                ///< of these, invalid in both scans

  void add(const std::vector<double>& first_m, const std::vector<double>& second_m);
  void add(const PairStatistics& other);
  double jumpRate() const { return compared ? static_cast<double>(jumps) / static_cast<double>(compared) : 0; }
  double flipRate() const { return beams ? static_cast<double>(flips) / static_cast<double>(beams) : 0; }
  double invalidRate() const { return beams ? static_cast<double>(invalid) / static_cast<double>(beams) : 0; }
};

PairStatistics statisticsOf(const ScanSeries& series, const std::vector<ScanPair>& pairs);

/// Each difference of multiples of a quantum plus a number that is uniform within ±quantum / 2, from fixed random
/// numbers, so that two samples can be compared as continuous ones.
std::vector<double> dequantised(std::vector<double> differences_m, double quantum_m, std::uint64_t seed);

/// Two-sample Kolmogorov–Smirnov distance: the largest difference of the empirical distribution functions. 1 for an
/// empty sample.
double ksDistance(std::vector<double> a, std::vector<double> b);
/// The distance that equal distributions exceed in 1 % of cases, max(0.05, 1.63 √(1/n + 1/m)).
double ksBound(std::size_t n, std::size_t m);

/// The largest q such that nearly all ranges are multiples of q, of 1 mm … 1 m; 0 for none.
double quantumOf(const ScanSeries& series);

}  // namespace robosim
