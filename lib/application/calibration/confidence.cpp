#include "calibration/confidence.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <boost/math/policies/policy.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>

namespace robosim {
namespace {

constexpr std::size_t kFewestClusters = 5;

// In double: Boost computes in long double otherwise, also tables at the start of a program, which end it under
// valgrind, whose long double has 64 bits.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

ConfidenceInterval binomialInterval(double hits, double trials) {
  constexpr double kTail = 0.025;
  if (!(trials > 0)) return {0, 1};
  hits = std::clamp(hits, 0.0, trials);
  ConfidenceInterval interval{0, 1};
  constexpr double kNone = 1e-9;
  if (hits > kNone) interval.low = boost::math::ibeta_inv(hits, trials - hits + 1, kTail, InDouble{});
  if (hits < trials - kNone) interval.high = boost::math::ibeta_inv(hits + 1, trials - hits, 1 - kTail, InDouble{});
  return interval;
}

double normalBound(double level) { return M_SQRT2 * boost::math::erfc_inv(level, InDouble{}); }

double designEffect(const std::vector<DependentTerm>& terms, double independent) {
  if (!(independent > 0)) return 0;
  std::map<std::uint32_t, double> of_beam, of_pair;
  for (const auto& term : terms) {
    of_beam[term.origin.beam] += term.value;
    of_pair[term.origin.pair] += term.value;
  }
  double effect = 0;
  if (of_beam.size() >= kFewestClusters) {
    double squares = 0;
    for (const auto& [beam, sum] : of_beam) squares += sum * sum;
    const auto n = static_cast<double>(of_beam.size());
    effect = squares * n / (n - 1) / independent;
  }
  if (of_pair.size() >= kFewestClusters) {
    double squares = 0;
    const std::pair<const std::uint32_t, double>* before = nullptr;
    for (const auto& pair : of_pair) {
      squares += pair.second * pair.second;
      // Half of it twice: the weight of Newey & West for one lag.
      if (before && before->first + 1 == pair.first) squares += before->second * pair.second;
      before = &pair;
    }
    const auto n = static_cast<double>(of_pair.size());
    effect = std::max(effect, squares * n / (n - 1) / independent);
  }
  return effect;
}

}  // namespace robosim
