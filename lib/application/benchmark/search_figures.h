#pragma once
#include <span>
#include <string>
#include <vector>

#include "benchmark/case_summary.h"
#include "benchmark/chart.h"

namespace robosim {

/// A chart of a report.
struct SearchFigure {
  std::string name;  ///< of its files, without ending: "survival_gold_cave_4_robots_noise"
  std::size_t world = 0;
  Chart chart;
};

/// The share of searches that go on over time, a line with its confidence band for each strategy: one chart for each
/// world, condition and team.
std::vector<SearchFigure> survivalFigures(const SearchPlan& plan, std::span<const CaseSummary> summaries);

/// Speed-up over the number of robots, both logarithmic: one chart for each world and condition; none when the plan has
/// one team.
std::vector<SearchFigure> speedUpFigures(const SearchPlan& plan, std::span<const CaseSummary> summaries);

}  // namespace robosim
