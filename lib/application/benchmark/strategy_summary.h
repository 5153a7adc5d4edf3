#pragma once
#include <optional>
#include <vector>

#include "benchmark/search_plan.h"
#include "benchmark/search_runs.h"
#include "benchmark/survival.h"

namespace robosim {

/// Figures of a strategy with a team under a condition over all worlds, of which there is at least one finished run.
struct StrategySummary {
  std::size_t condition = 0, team = 0, strategy = 0;  ///< indices of the plan
  std::size_t runs = 0, found = 0;
  Interval success;     ///< share, 95 % (shareInterval())
  double median_s = 0;  ///< of the times in all worlds together; infinite when at most half of the searches succeeded
  /// As CaseSummary::competitive_ratio, over the starts in all worlds.
  std::optional<double> competitive_ratio;
};

/// Ordered by condition, team and strategy.
std::vector<StrategySummary> summariseStrategies(const SearchPlan& plan, const SearchRuns& runs);

}  // namespace robosim
