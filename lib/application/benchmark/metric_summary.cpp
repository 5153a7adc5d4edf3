#include "benchmark/metric_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/run_summary.h"

namespace robosim {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// The first value at which at most `searching` of the runs have none yet; infinite when there is none.
double computeQuantile(const std::vector<SurvivalStep>& curve, double searching) {
  constexpr double kRounding = 1e-12;
  for (const auto& step : curve) {
    if (step.searching <= searching + kRounding) return step.time_s;
  }
  return std::numeric_limits<double>::infinity();
}

/// How long a run was observed [s].
double observedTime(const SearchRun& run, double limit_s) {
  return run.ended_by == nameOf(EndedBy::all_halted) ? limit_s : run.sim_time_s;
}

MetricSummary summaryOf(std::size_t metric, std::span<const SearchRun* const> runs, double limit_s,
                        std::uint64_t seed) {
  MetricSummary summary;
  summary.name = runs.front()->metrics[metric].name;
  summary.runs = runs.size();
  const bool is_time = isTime(summary.name);
  std::vector<SearchTime> times;
  double mean = 0, squares = 0;
  for (const SearchRun* run : runs) {
    const double value = run->metrics[metric].value;
    const bool has_value = std::isfinite(value);
    if (has_value || is_time) times.push_back({has_value ? value : observedTime(*run, limit_s), has_value});
    if (!has_value) continue;
    ++summary.values;
    const double step = value - mean;
    mean += step / static_cast<double>(summary.values);
    squares += step * (value - mean);
  }
  const bool is_censored = is_time && summary.values < summary.runs;
  summary.mean = summary.values == 0 || is_censored ? kMissing : mean;
  summary.deviation =
      summary.values < 2 || is_censored ? kMissing : std::sqrt(squares / static_cast<double>(summary.values - 1));
  if (times.empty()) {
    summary.quantile10 = summary.median = summary.quantile90 = kMissing;
    summary.median_interval = {kMissing, kMissing};
    return summary;
  }
  const auto curve = survivalCurve(times);
  summary.quantile10 = computeQuantile(curve, 0.9);
  summary.median = medianTime(times);
  summary.quantile90 = computeQuantile(curve, 0.1);
  summary.median_interval = medianInterval(times, seed);
  return summary;
}

}  // namespace

bool isTime(const std::string& metric) { return metric.ends_with("_s") && !metric.ends_with("_per_s"); }

std::vector<MetricSummary> summariseMetrics(std::span<const SearchRun* const> runs, double limit_s,
                                            std::uint64_t seed) {
  std::vector<MetricSummary> summaries;
  for (std::size_t i = 0; i < runs.front()->metrics.size(); ++i) {
    summaries.push_back(summaryOf(i, runs, limit_s, seed));
  }
  return summaries;
}

}  // namespace robosim
