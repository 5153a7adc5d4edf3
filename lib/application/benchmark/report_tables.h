#pragma once
#include <span>
#include <string>

#include "benchmark/case_summary.h"

namespace robosim {

/// The strategies over all worlds together: found, median, and times oracle if it takes part, for each team.
std::string overviewTable(const SearchPlan& plan, const SearchRuns& runs, std::size_t condition);
/// All figures of strategies and teams in a world.
std::string resultsTable(const SearchPlan& plan, std::span<const CaseSummary> summaries, std::size_t world,
                         std::size_t condition);
std::string comparisonsTable(const SearchPlan& plan, std::span<const StrategyComparison> comparisons,
                             std::size_t condition);
/// @param condition not the first
std::string robustnessTable(const SearchPlan& plan, std::span<const Robustness> all, std::size_t condition);

}  // namespace robosim
