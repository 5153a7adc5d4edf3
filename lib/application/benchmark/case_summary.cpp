#include "benchmark/case_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmark/metric_summary.h"
#include "benchmark/search_pairs.h"

namespace robosim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double timeOf(const SearchRun& run) { return run.found_s.value_or(kNever); }

/// The `share` quantile of the values (nearest rank); infinity for an infinite one. @pre not empty
double computeQuantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

void addMeans(std::span<const SearchRun* const> runs, CaseSummary& summary) {
  const auto mean = [&](const auto& value) {
    double sum = 0, n = 0;
    for (const SearchRun* run : runs) {
      const double x = value(*run);
      if (!std::isfinite(x)) continue;
      sum += x;
      ++n;
    }
    return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
  };
  summary.driven_m = mean([](const SearchRun& run) { return run.driven_m; });
  summary.stalls = mean([](const SearchRun& run) { return static_cast<double>(run.stalls); });
  summary.messages = mean([](const SearchRun& run) { return static_cast<double>(run.messages_sent); });
  summary.energy_wh = mean([](const SearchRun& run) { return run.metric(kEnergyMetric); });
  summary.message_bytes = mean([](const SearchRun& run) { return run.metric(kBytesMetric); });
  summary.overlap = mean([](const SearchRun& run) { return run.metric(kOverlapMetric); });
  for (const auto& metric : runs.front()->metrics) {
    if (metric.name.starts_with("effort.")) continue;
    const auto value = [&](const SearchRun& run) { return run.metric(metric.name); };
    const bool is_known = !isTime(metric.name) || std::all_of(runs.begin(), runs.end(), [&](const SearchRun* run) {
      return std::isfinite(value(*run));
    });
    summary.metrics.push_back({metric.name, is_known ? mean(value) : std::numeric_limits<double>::quiet_NaN()});
  }
}

}  // namespace

std::vector<CaseSummary> summarise(const SearchPlan& plan, const SearchRuns& runs) {
  std::vector<CaseSummary> summaries;
  const auto oracle = findOracle(plan);
  for (std::size_t index = 0; index < plan.caseCount(); ++index) {
    std::vector<const SearchRun*> finished;
    std::vector<SearchTime> times;
    std::vector<double> found_s;
    for (std::size_t i = 0; i < plan.runs; ++i) {
      const auto& run = runs[index * plan.runs + i];
      if (!run) continue;
      finished.push_back(&*run);
      times.push_back(run->searchTime(plan.time_s));
      found_s.push_back(timeOf(*run));
    }
    if (finished.empty()) continue;
    CaseSummary summary;
    summary.of = plan.caseAt(index);
    summary.runs = finished.size();
    summary.found = static_cast<std::size_t>(
        std::count_if(times.begin(), times.end(), [](const SearchTime& time) { return time.is_found; }));
    summary.success = shareInterval(summary.found, summary.runs);
    summary.median_s = medianTime(times);
    summary.median_interval_s = medianInterval(times, plan.seed);
    summary.quantile90_s = computeQuantile(found_s, 0.9);
    summary.survival = survivalCurve(times);
    if (oracle) {
      SearchPlan::Case bound = summary.of;
      bound.strategy = *oracle;
      bound.condition = 0;
      SearchPairs pairs;
      pairs.add(plan, runs, bound, summary.of);
      summary.competitive_ratio = medianRatio(pairs);
    }
    addMeans(finished, summary);
    summaries.push_back(std::move(summary));
  }
  const std::size_t smallest =
      static_cast<std::size_t>(std::min_element(plan.teams.begin(), plan.teams.end()) - plan.teams.begin());
  if (plan.teams.size() < 2) return summaries;
  for (auto& summary : summaries) {
    SearchPlan::Case alone = summary.of;
    alone.team = smallest;
    const auto of_alone =
        std::find_if(summaries.begin(), summaries.end(), [&](const CaseSummary& other) { return other.of == alone; });
    if (of_alone == summaries.end() || !std::isfinite(summary.median_s) || !std::isfinite(of_alone->median_s)) continue;
    if (summary.median_s > 0) summary.speed_up = of_alone->median_s / summary.median_s;
  }
  return summaries;
}

std::vector<StrategyComparison> compareStrategies(const SearchPlan& plan, const SearchRuns& runs, bool by_world) {
  std::vector<StrategyComparison> comparisons;
  const std::size_t groups = by_world ? plan.worlds.size() : 1;
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t condition = 0; condition < plan.conditions.size(); ++condition) {
      for (std::size_t team = 0; team < plan.teams.size(); ++team) {
        for (std::size_t first = 0; first < plan.strategies.size(); ++first) {
          for (std::size_t second = first + 1; second < plan.strategies.size(); ++second) {
            SearchPairs pairs;
            for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
              if (by_world && world != group) continue;
              pairs.add(plan, runs, {world, condition, team, first}, {world, condition, team, second});
            }
            if (pairs.first.empty()) continue;
            StrategyComparison comparison{condition, team, first, second, std::nullopt, {}, 1};
            if (by_world) comparison.world = group;
            comparison.result = comparePaired(pairs.first, pairs.second);
            comparisons.push_back(comparison);
          }
        }
      }
    }
  }
  std::vector<double> p;
  for (const auto& comparison : comparisons) p.push_back(comparison.result.p);
  const auto adjusted = holmAdjusted(p);
  for (std::size_t i = 0; i < comparisons.size(); ++i) comparisons[i].adjusted_p = adjusted[i];
  return comparisons;
}

std::vector<Robustness> computeRobustness(const SearchPlan& plan, const SearchRuns& runs) {
  std::vector<Robustness> all;
  for (std::size_t condition = 1; condition < plan.conditions.size(); ++condition) {
    for (std::size_t team = 0; team < plan.teams.size(); ++team) {
      for (std::size_t strategy = 0; strategy < plan.strategies.size(); ++strategy) {
        SearchPairs pairs;
        for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
          pairs.add(plan, runs, {world, 0, team, strategy}, {world, condition, team, strategy});
        }
        if (pairs.first.empty()) continue;
        Robustness robustness{condition, team, strategy, pairs.first.size(), 0, 0, kNever, {}, 1};
        const auto found = [](const std::vector<SearchTime>& times) {
          return static_cast<std::size_t>(
              std::count_if(times.begin(), times.end(), [](const SearchTime& time) { return time.is_found; }));
        };
        robustness.found_at_first = found(pairs.first);
        robustness.found = found(pairs.second);
        robustness.median_ratio = medianRatio(pairs).value_or(std::numeric_limits<double>::quiet_NaN());
        robustness.result = comparePaired(pairs.first, pairs.second);
        all.push_back(robustness);
      }
    }
  }
  std::vector<double> p;
  for (const auto& robustness : all) p.push_back(robustness.result.p);
  const auto adjusted = holmAdjusted(p);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].adjusted_p = adjusted[i];
  return all;
}

}  // namespace robosim
