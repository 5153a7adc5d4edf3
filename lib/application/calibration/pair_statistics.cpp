#include "calibration/pair_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace robosim {

std::size_t findBand(double range_m) {
  std::size_t band = 0;
  while (band + 1 < kBands && range_m >= kBandLimits_m[band + 1]) ++band;
  return band;
}

const char* bandName(std::size_t band) {
  static constexpr std::array kNames{"0 … 2 m", "2 … 4 m", "4 … 6 m", "6 … 8 m", "> 8 m"};
  static_assert(kNames.size() == kBands);
  return kNames[band];
}

void PairStatistics::add(const std::vector<double>& first_m, const std::vector<double>& second_m,
                         const std::vector<double>& range_m) {
  const auto pair = static_cast<std::uint32_t>(pairs++);
  for (std::size_t i = 0; i < std::min(first_m.size(), second_m.size()); ++i) {
    ++beams;
    const bool is_first = !std::isnan(first_m[i]), is_second = !std::isnan(second_m[i]);
    flips += is_first != is_second;
    invalid += !is_first && !is_second;
    if (!is_first || !is_second) continue;
    ++compared;
    const double difference_m = second_m[i] - first_m[i];
    const DifferenceOrigin origin{pair, static_cast<std::uint32_t>(i)};
    if (std::abs(difference_m) > jump_m) {
      ++jumps;
      jump_origins.push_back(origin);
      continue;
    }
    const double at_m = range_m.empty() ? (first_m[i] + second_m[i]) / 2 : range_m[i];
    const std::size_t band = findBand(at_m);
    differences_m[band].push_back(difference_m);
    origins[band].push_back(origin);
    if (range_max_m > 0) {
      outlier_window +=
          std::max(0.0, std::min(at_m + jump_m, range_max_m) - std::max(at_m - jump_m, 0.0)) / range_max_m;
    }
  }
}

void PairStatistics::add(const PairStatistics& other) {
  const auto renumbered = [&](DifferenceOrigin origin) {
    origin.pair += static_cast<std::uint32_t>(pairs);
    return origin;
  };
  for (std::size_t band = 0; band < kBands; ++band) {
    const auto& more = other.differences_m[band];
    differences_m[band].insert(differences_m[band].end(), more.begin(), more.end());
    for (const auto& origin : other.origins[band]) origins[band].push_back(renumbered(origin));
  }
  for (const auto& origin : other.jump_origins) jump_origins.push_back(renumbered(origin));
  pairs += other.pairs;
  compared += other.compared;
  jumps += other.jumps;
  beams += other.beams;
  flips += other.flips;
  invalid += other.invalid;
  outlier_window += other.outlier_window;
}

PairStatistics computeStatistics(const ScanSeries& series, const std::vector<ScanPair>& pairs, double jump_m) {
  PairStatistics statistics{.jump_m = jump_m, .range_max_m = series.range_max_m};
  for (const auto& group : standingGroups(series, pairs)) {
    const std::vector<double> range_m = medianRanges(series, group);
    for (const auto& pair : group) {
      statistics.add(series.scans[pair.first].ranges_m, series.scans[pair.first + 1].ranges_m, range_m);
    }
  }
  return statistics;
}

double computeJumpLimit(std::vector<double> differences_m, double quantum_m) {
  constexpr double kRobustStd = 1.4826;  // median of the absolute values of a Gaussian, inverted
  double limit_m = kJump_m;
  if (!differences_m.empty()) {
    for (auto& difference_m : differences_m) difference_m = std::abs(difference_m);
    const auto middle = differences_m.begin() + static_cast<std::ptrdiff_t>(differences_m.size() / 2);
    std::nth_element(differences_m.begin(), middle, differences_m.end());
    limit_m = std::max(kJump_m, 6 * kRobustStd * *middle);
  }
  return quantum_m > 0 ? (std::floor(limit_m / quantum_m + 1e-6) + 0.5) * quantum_m : limit_m;
}

double computeJumpLimit(const ScanSeries& series, const std::vector<ScanPair>& pairs, double quantum_m) {
  const PairStatistics all = computeStatistics(series, pairs, std::numeric_limits<double>::infinity());
  std::vector<double> differences_m;
  for (const auto& of_band : all.differences_m)
    differences_m.insert(differences_m.end(), of_band.begin(), of_band.end());
  return computeJumpLimit(std::move(differences_m), quantum_m);
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

double ksBound(std::size_t n, std::size_t m, double level) {
  if (n == 0 || m == 0) return 1;
  const double scale = std::sqrt(-std::log(level / 2) / 2);
  return std::max(0.05, scale * std::sqrt(1 / static_cast<double>(n) + 1 / static_cast<double>(m)));
}

double estimateQuantum(const ScanSeries& series) {
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
