#include "calibration/pair_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace robosim {

std::size_t bandOf(double range_m) {
  std::size_t band = 0;
  while (band + 1 < kBands && range_m >= kBandLimits_m[band + 1]) ++band;
  return band;
}

const char* bandName(std::size_t band) {
  static constexpr std::array kNames{"0 … 2 m", "2 … 4 m", "4 … 6 m", "6 … 8 m", "> 8 m"};
  static_assert(kNames.size() == kBands);
  return kNames[band];
}

void PairStatistics::add(const std::vector<double>& first_m, const std::vector<double>& second_m) {
  ++pairs;
  for (std::size_t i = 0; i < std::min(first_m.size(), second_m.size()); ++i) {
    ++beams;
    const bool is_first = !std::isnan(first_m[i]), is_second = !std::isnan(second_m[i]);
    flips += is_first != is_second;
    invalid += !is_first && !is_second;
    if (!is_first || !is_second) continue;
    ++compared;
    const double difference_m = second_m[i] - first_m[i];
    if (std::abs(difference_m) > kJump_m) {
      ++jumps;
    } else {
      differences_m[bandOf((first_m[i] + second_m[i]) / 2)].push_back(difference_m);
    }
  }
}

void PairStatistics::add(const PairStatistics& other) {
  pairs += other.pairs;
  compared += other.compared;
  jumps += other.jumps;
  beams += other.beams;
  flips += other.flips;
  invalid += other.invalid;
  for (std::size_t band = 0; band < kBands; ++band) {
    const auto& more = other.differences_m[band];
    differences_m[band].insert(differences_m[band].end(), more.begin(), more.end());
  }
}

PairStatistics statisticsOf(const ScanSeries& series, const std::vector<ScanPair>& pairs) {
  PairStatistics statistics;
  for (const auto& pair : pairs) {
    statistics.add(series.scans[pair.first].ranges_m, series.scans[pair.first + 1].ranges_m);
  }
  return statistics;
}

std::vector<double> dequantised(std::vector<double> differences_m, double quantum_m, std::uint64_t seed) {
  Rng rng(seed);
  for (auto& difference_m : differences_m) difference_m += quantum_m * rng.uniform(-0.5, 0.5);
  return differences_m;
}

double ksDistance(std::vector<double> a, std::vector<double> b) {
  if (a.empty() || b.empty()) return 1;
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double largest = 0;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    const double at = std::min(a[i], b[k]);
    while (i < a.size() && a[i] == at) ++i;
    while (k < b.size() && b[k] == at) ++k;
    largest = std::max(largest, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                         static_cast<double>(k) / static_cast<double>(b.size())));
  }
  return largest;
}

double ksBound(std::size_t n, std::size_t m) {
  if (n == 0 || m == 0) return 1;
  return std::max(0.05, 1.63 * std::sqrt(1 / static_cast<double>(n) + 1 / static_cast<double>(m)));
}

double quantumOf(const ScanSeries& series) {
  constexpr double kQuanta_m[] = {1, 0.5, 0.25, 0.2, 0.1, 0.05, 0.025, 0.02, 0.01, 0.005, 0.0025, 0.002, 0.001};
  constexpr double kMost = 0.98;      // of the ranges
  constexpr double kRounding = 0.02;  // of a quantum: ranges are recorded in single precision
  for (const double quantum_m : kQuanta_m) {
    std::size_t all = 0, multiples = 0;
    for (const auto& scan : series.scans) {
      for (const double range_m : scan.ranges_m) {
        if (std::isnan(range_m)) continue;
        ++all;
        const double steps = range_m / quantum_m;
        multiples += std::abs(steps - std::round(steps)) < kRounding;
      }
    }
    if (all > 0 && static_cast<double>(multiples) > kMost * static_cast<double>(all)) return quantum_m;
  }
  return 0;
}

}  // namespace robosim
