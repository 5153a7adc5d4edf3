#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace robosim {

/// How long a search took: until its success, or until it was ended without (a censored time).
struct SearchTime {
  double time_s = 0;  ///< at least 0
  bool is_found = false;
};

/// A step of a survival curve: from this time on, the probability that a search is still going on.
struct SurvivalStep {
  double time_s = 0;
  double searching = 1;      ///< estimate, [0, 1]
  double low = 1, high = 1;  ///< its pointwise 95 % confidence band
  std::size_t at_risk = 0;   ///< searches still going on just before this time
};

/// The estimator of Kaplan and Meier (1958), with the variance of Greenwood (1926) and a band on the scale log(-log),
/// which keeps it within [0, 1] (Kalbfleisch & Prentice, "The Statistical Analysis of Failure Time Data", 1980). One
/// step for each time at which a search succeeded, in their order. After the last success without censored times the
/// curve is 0, as is the lower end of the band; its upper end is that of the step before.
std::vector<SurvivalStep> survivalCurve(std::span<const SearchTime> times);

/// The first time at which at most half of the searches were still going on; infinite when there is none.
double medianTime(std::span<const SearchTime> times);

struct Interval {
  double low = 0;
  double high = std::numeric_limits<double>::infinity();
};

/// 95 % interval of the median from the percentiles of `resamples` bootstrap samples (Efron, 1981: "Censored data and
/// the bootstrap"). @pre times is not empty
Interval medianInterval(std::span<const SearchTime> times, std::uint64_t seed, int resamples = 2000);

/// 95 % interval of a share of successes (Wilson, 1927). @pre 0 <= successes <= trials, trials > 0
Interval shareInterval(std::size_t successes, std::size_t trials);

}  // namespace robosim
