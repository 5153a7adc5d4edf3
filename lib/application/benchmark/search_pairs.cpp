#include "benchmark/search_pairs.h"

#include <algorithm>
#include <limits>

#include "base/type_choice.h"
#include "benchmark/case_summary.h"

namespace robosim {
namespace {

double computeMedian(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1 || values[half] == values[half - 1]) return values[half];
  return (values[half - 1] + values[half]) / 2;
}

}  // namespace

std::optional<std::size_t> findOracle(const SearchPlan& plan) {
  for (std::size_t i = 0; i < plan.strategies.size(); ++i) {
    const std::string& strategy = plan.strategies[i];
    if (!strategy.empty() && TypeChoice::parse(strategy).name == kOracle) return i;
  }
  return std::nullopt;
}

void SearchPairs::add(const SearchPlan& plan, const SearchRuns& runs, const SearchPlan::Case& a,
                      const SearchPlan::Case& b) {
  for (std::size_t i = 0; i < plan.runs; ++i) {
    const auto& x = runs[plan.indexOf(a) * plan.runs + i];
    const auto& y = runs[plan.indexOf(b) * plan.runs + i];
    if (!x || !y) continue;
    first.push_back(x->searchTime(plan.time_s));
    second.push_back(y->searchTime(plan.time_s));
  }
}

std::optional<double> medianRatio(const SearchPairs& pairs) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    const SearchTime& bound = pairs.first[i];
    const SearchTime& time = pairs.second[i];
    if (!bound.is_found) continue;
    if (!time.is_found) {
      ratios.push_back(std::numeric_limits<double>::infinity());
    } else {
      ratios.push_back(bound.time_s > 0 ? time.time_s / bound.time_s : 1);  // at the start: found at once by both
    }
  }
  if (ratios.empty()) return std::nullopt;
  return computeMedian(ratios);
}

}  // namespace robosim
