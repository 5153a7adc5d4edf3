#pragma once
#include <optional>
#include <vector>

#include "benchmark/search_plan.h"
#include "benchmark/search_runs.h"
#include "benchmark/survival.h"

namespace robosim {

/// The index of the strategy that knows the map (kOracle); nullopt for none.
std::optional<std::size_t> findOracle(const SearchPlan& plan);

/// Times of two cases with equal seeds, where both runs are finished.
struct SearchPairs {
  std::vector<SearchTime> first, second;
  void add(const SearchPlan& plan, const SearchRuns& runs, const SearchPlan::Case& a, const SearchPlan::Case& b);
};

/// Median of second relative to first, over the pairs of which the first succeeded, counting searches without success
/// as infinite; nullopt for none.
std::optional<double> medianRatio(const SearchPairs& pairs);

}  // namespace robosim
