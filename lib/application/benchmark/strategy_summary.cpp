#include "benchmark/strategy_summary.h"

#include <algorithm>

#include "benchmark/search_pairs.h"

namespace robosim {

std::vector<StrategySummary> summariseStrategies(const SearchPlan& plan, const SearchRuns& runs) {
  std::vector<StrategySummary> summaries;
  const auto oracle = findOracle(plan);
  for (std::size_t condition = 0; condition < plan.conditions.size(); ++condition) {
    for (std::size_t team = 0; team < plan.teams.size(); ++team) {
      for (std::size_t strategy = 0; strategy < plan.strategies.size(); ++strategy) {
        SearchPairs own, bound;
        for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
          const SearchPlan::Case of{world, condition, team, strategy};
          own.add(plan, runs, of, of);
          if (oracle) bound.add(plan, runs, {world, 0, team, *oracle}, of);
        }
        if (own.first.empty()) continue;
        StrategySummary summary{condition, team, strategy, own.first.size(), 0, {}, medianTime(own.first), {}};
        summary.found = static_cast<std::size_t>(
            std::count_if(own.first.begin(), own.first.end(), [](const SearchTime& time) { return time.is_found; }));
        summary.success = shareInterval(summary.found, summary.runs);
        if (oracle) summary.competitive_ratio = medianRatio(bound);
        summaries.push_back(summary);
      }
    }
  }
  return summaries;
}

}  // namespace robosim
