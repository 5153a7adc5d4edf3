#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "benchmark/search_run.h"
#include "benchmark/survival.h"

namespace robosim {

/// Distribution of a metric over the runs of a case.
///
/// A metric whose name ends in "_s", but not in "_per_s", is the time of an event when some runs have no value: their
/// events come later than these runs were observed, and the quantiles are those of the survival curve
/// (survivalCurve()). Leaving such runs out would give the mean of the fast ones. Other metrics have the quantiles of
/// the values.
struct MetricSummary {
  std::string name;
  std::size_t runs = 0, values = 0;  ///< number of runs, and of those that have a value
  double mean = 0;                   ///< NaN for no value, and for a time that some runs have not
  double deviation = 0;              ///< standard deviation of the sample; NaN as the mean, and for one value
  double quantile10 = 0, median = 0, quantile90 = 0;  ///< infinite: beyond the ends of the runs; NaN: no value
  Interval median_interval;                           ///< 95 % (medianInterval())
};

/// Whether a metric without a value is an event that has not happened.
bool isTime(const std::string& metric);

/// The metrics of runs, of which there is at least one, in their order. All runs have the same ones.
/// @param limit_s time limit of the runs. A run whose robots have all halted counts as observed until then, because
/// nothing would have happened in it; one that an observer has ended, until its end
/// @param seed of the bootstrap samples
std::vector<MetricSummary> summariseMetrics(std::span<const SearchRun* const> runs, double limit_s, std::uint64_t seed);

}  // namespace robosim
