#include "benchmark/survival.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace robosim {
namespace {

constexpr double kNormal95 = 1.959963984540054;  // 97.5 % quantile of the normal distribution

std::vector<SearchTime> sorted(std::span<const SearchTime> times) {
  std::vector<SearchTime> all(times.begin(), times.end());
  // At equal times, successes come first: a search ended at that time was at risk until then.
  std::sort(all.begin(), all.end(), [](const SearchTime& a, const SearchTime& b) {
    return a.time_s != b.time_s ? a.time_s < b.time_s : a.is_found > b.is_found;
  });
  return all;
}

/// Median of sorted times.
double medianOfSorted(std::span<const SearchTime> times) {
  double searching = 1;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!times[i].is_found) continue;
    const auto at_risk = static_cast<double>(times.size() - i);
    searching *= (at_risk - 1) / at_risk;
    // Rounding must not move a median that is exactly one half.
    if (searching <= 0.5 + 1e-12) return times[i].time_s;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<SurvivalStep> survivalCurve(std::span<const SearchTime> times) {
  const auto all = sorted(times);
  std::vector<SurvivalStep> curve;
  SurvivalStep now;
  double variance_sum = 0;  // Greenwood's
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i, found = 0;
    for (; end < all.size() && all[end].time_s == all[i].time_s; ++end) found += all[end].is_found ? 1 : 0;
    if (found > 0) {
      const auto at_risk = static_cast<double>(all.size() - i);
      const auto successes = static_cast<double>(found);
      now.time_s = all[i].time_s;
      now.at_risk = all.size() - i;
      now.searching *= (at_risk - successes) / at_risk;
      if (now.searching > 0) {
        variance_sum += successes / (at_risk * (at_risk - successes));
        const double log_survival = std::log(now.searching);
        const double spread = std::exp(kNormal95 * std::sqrt(variance_sum) / -log_survival);
        now.low = std::pow(now.searching, spread);
        now.high = std::pow(now.searching, 1 / spread);
      } else {
        now.low = 0;
      }
      curve.push_back(now);
    }
    i = end;
  }
  return curve;
}

double medianTime(std::span<const SearchTime> times) { return medianOfSorted(sorted(times)); }

Interval medianInterval(std::span<const SearchTime> times, std::uint64_t seed, int resamples) {
  const auto all = sorted(times);
  const auto count = static_cast<std::uint32_t>(all.size());
  Rng rng(seed, RandomPurpose::bootstrap, 0, 0, 0);
  std::vector<double> medians;
  std::vector<std::uint32_t> drawn(all.size());
  std::vector<SearchTime> sample(all.size());
  for (int i = 0; i < resamples; ++i) {
    // Indices of sorted times need no comparison of times.
    for (auto& index : drawn) index = rng.below(count);
    std::sort(drawn.begin(), drawn.end());
    for (std::size_t k = 0; k < drawn.size(); ++k) sample[k] = all[drawn[k]];
    medians.push_back(medianOfSorted(sample));
  }
  std::sort(medians.begin(), medians.end());
  const auto at = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(medians.size())));
    return medians[std::clamp<std::size_t>(rank, 1, medians.size()) - 1];
  };
  return {at(0.025), at(0.975)};
}

Interval shareInterval(std::size_t successes, std::size_t trials) {
  const auto n = static_cast<double>(trials);
  const double share = static_cast<double>(successes) / n;
  const double z2 = kNormal95 * kNormal95;
  const double center = (share + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kNormal95 / (1 + z2 / n) * std::sqrt(share * (1 - share) / n + z2 / (4 * n * n));
  return {successes == 0 ? 0 : center - half, successes == trials ? 1 : center + half};
}

}  // namespace robosim
