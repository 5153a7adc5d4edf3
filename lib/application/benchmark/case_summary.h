#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmark/paired_comparison.h"
#include "benchmark/search_plan.h"
#include "benchmark/search_runs.h"
#include "benchmark/survival.h"

namespace robosim {

/// Name of the strategy that knows the map, whose time is the bound of the others.
inline constexpr const char* kOracle = "oracle";

/// Figures of one case over its finished runs, of which there is at least one.
struct CaseSummary {
  SearchPlan::Case of;
  std::size_t runs = 0, found = 0;
  Interval success;     ///< share, 95 % (shareInterval())
  double median_s = 0;  ///< infinite when at most half of the searches succeeded; the same for all times
  Interval median_interval_s;
  double quantile90_s = 0;
  std::vector<SurvivalStep> survival;
  /// Median over the runs of time relative to the oracle's from the same start, counting searches without success as
  /// infinite; nullopt without the oracle in the plan, or without its success in any run.
  std::optional<double> competitive_ratio;
  /// Median of the smallest team relative to this one's, of the same strategy, world and condition; nullopt with one
  /// team only, or when either is infinite.
  std::optional<double> speed_up;
  double driven_m = 0, energy_wh = 0, messages = 0, message_bytes = 0, overlap = 0, stalls = 0;  ///< means over runs
  /// Means of the other observers' over the runs that have a value; NaN for none, and for a time (isTime()) that some
  /// runs have not.
  std::vector<Metric> metrics;
};

/// One for each case with finished runs, in the order of the plan.
std::vector<CaseSummary> summarise(const SearchPlan& plan, const SearchRuns& runs);

/// Two strategies in the same worlds, with equal teams, conditions and starts.
struct StrategyComparison {
  std::size_t condition = 0, team = 0, first = 0, second = 0;  ///< indices of the plan; the strategies are different
  std::optional<std::size_t> world;                            ///< nullopt: all worlds together
  PairedComparison result;
  double adjusted_p = 1;  ///< Holm's, for all comparisons of the same list
};

/// All pairs of strategies over all worlds together. @param by_world each world alone instead
std::vector<StrategyComparison> compareStrategies(const SearchPlan& plan, const SearchRuns& runs, bool by_world);

/// One strategy under a condition beside the plan's first condition, over all worlds, with equal starts.
struct Robustness {
  std::size_t condition = 0, team = 0, strategy = 0;
  std::size_t runs = 0, found = 0, found_at_first = 0;
  double median_ratio = 1;  ///< median over the runs of the time relative to that under the first condition
  PairedComparison result;  ///< `first`: the first condition
  double adjusted_p = 1;    ///< Holm's, for all of the list
};
std::vector<Robustness> computeRobustness(const SearchPlan& plan, const SearchRuns& runs);

}  // namespace robosim
