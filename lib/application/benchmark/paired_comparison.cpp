#include "benchmark/paired_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace robosim {
namespace {

/// Probability of at most `wins` of `trials` fair throws.
double binomialBelow(std::size_t wins, std::size_t trials) {
  const auto n = static_cast<double>(trials);
  double sum = 0;
  for (std::size_t k = 0; k <= wins; ++k) {
    const auto i = static_cast<double>(k);
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) - n * std::log(2.0));
  }
  return sum;
}

}  // namespace

PairedComparison comparePaired(std::span<const SearchTime> first, std::span<const SearchTime> second) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  PairedComparison result;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double a = first[i].is_found ? first[i].time_s : kNever;
    const double b = second[i].is_found ? second[i].time_s : kNever;
    ++(a < b ? result.first_faster : b < a ? result.second_faster : result.ties);
  }
  const std::size_t decided = result.first_faster + result.second_faster;
  const std::size_t fewer = std::min(result.first_faster, result.second_faster);
  result.p = decided == 0 ? 1 : std::min(1.0, 2 * binomialBelow(fewer, decided));
  return result;
}

std::vector<double> holmAdjusted(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(p.size() - rank) * p[order[rank]]));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

}  // namespace robosim
