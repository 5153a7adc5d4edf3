// The tables of a report's page.
#include "benchmark/report_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/html_table.h"
#include "base/html_text.h"
#include "base/text_table.h"
#include "benchmark/search_pairs.h"
#include "benchmark/strategy_summary.h"

namespace robosim {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

std::string teamCell(const SearchPlan& plan, std::size_t team) {
  return plan.teams[team] == 0 ? "its own" : std::to_string(plan.teams[team]);
}

std::string cell(std::size_t number) { return std::to_string(number); }

std::string optionalCell(const std::optional<double>& value, int decimals) {
  return numberCell(value.value_or(kNoValue), decimals);
}

std::string secondsText(double value) { return std::isfinite(value) ? fixed(value, 1) : "never"; }

/// Below 0.001 with two digits; else three decimals.
std::string probability(double p) {
  if (p >= 0.001) return fixed(p, 3);
  return p < 1e-6 ? "&lt; 0.000001" : fixed(p, 6);
}

/// A figure of all strategies with all teams, of which the best of each team is emphasised.
class StrategyFigures {
 public:
  StrategyFigures(std::size_t teams, int decimals, bool is_most_best)
      : best_(teams, is_most_best ? -kInfinity : kInfinity), decimals_(decimals), is_most_best_(is_most_best) {}

  /// @param is_bound is not compared: the oracle's
  void set(std::size_t team, std::size_t strategy, double value, bool is_bound) {
    values_[{team, strategy}] = {value, is_bound};
    if (is_bound || std::isnan(value)) return;
    best_[team] = is_most_best_ ? std::max(best_[team], value) : std::min(best_[team], value);
  }
  std::string cellOf(std::size_t team, std::size_t strategy) const {
    const auto found = values_.find({team, strategy});
    if (found == values_.end()) return numberCell(kNoValue, 0);
    const auto [value, is_bound] = found->second;
    const std::string text = numberCell(value, decimals_);
    return !is_bound && std::isfinite(value) && value == best_[team] ? "<b>" + text + "</b>" : text;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::map<std::pair<std::size_t, std::size_t>, std::pair<double, bool>> values_;
  std::vector<double> best_;
  int decimals_;
  bool is_most_best_;
};

}  // namespace

std::string overviewTable(const SearchPlan& plan, const SearchRuns& runs, std::size_t condition) {
  const auto oracle = findOracle(plan);
  const std::size_t teams = plan.teams.size();
  StrategyFigures found(teams, 1, true), median(teams, 1, false), ratio(teams, 2, false);
  std::vector<std::size_t> strategies;
  for (const auto& summary : summariseStrategies(plan, runs)) {
    if (summary.condition != condition) continue;
    if (std::find(strategies.begin(), strategies.end(), summary.strategy) == strategies.end()) {
      strategies.push_back(summary.strategy);
    }
    const bool is_bound = summary.strategy == oracle;
    found.set(summary.team, summary.strategy,
              100 * static_cast<double>(summary.found) / static_cast<double>(summary.runs), is_bound);
    median.set(summary.team, summary.strategy, summary.median_s, is_bound);
    ratio.set(summary.team, summary.strategy, summary.competitive_ratio.value_or(kNoValue), is_bound);
  }
  std::sort(strategies.begin(), strategies.end());
  std::vector<std::pair<std::string, const StrategyFigures*>> groups{{"found [%]", &found}, {"median [s]", &median}};
  if (oracle) groups.emplace_back("times oracle", &ratio);
  std::vector<std::string> names{"strategy"};
  std::vector<std::pair<std::string, int>> spans{{"", 1}};
  for (const auto& [name, figures] : groups) {
    spans.emplace_back(name + ", by robots", static_cast<int>(teams));
    for (std::size_t team = 0; team < teams; ++team) names.push_back(teamCell(plan, team));
  }
  HtmlTable table(names, false);
  table.addGroups(spans);
  for (const std::size_t strategy : strategies) {
    std::vector<std::string> cells{escapedHtml(plan.strategyName(strategy))};
    for (const auto& [name, figures] : groups) {
      for (std::size_t team = 0; team < teams; ++team) cells.push_back(figures->cellOf(team, strategy));
    }
    table.add(cells);
  }
  return table.html();
}

std::string resultsTable(const SearchPlan& plan, std::span<const CaseSummary> summaries, std::size_t world,
                         std::size_t condition) {
  std::vector<std::string> names{
      "strategy",          "robots",   "runs",         "success [%]", "95 % interval", "median [s]",
      "95 % interval [s]", "90 % [s]", "times oracle", "speed-up",    "driven [m]",    "energy [Wh]",
      "messages",          "bytes",    "overlap [%]",  "stalls"};
  if (!summaries.empty()) {
    for (const auto& metric : summaries.front().metrics) names.push_back(metric.name);
  }
  HtmlTable table(names, true);
  for (const auto& s : summaries) {
    if (s.of.world != world || s.of.condition != condition) continue;
    std::vector<std::string> cells{
        escapedHtml(plan.strategyName(s.of.strategy)),
        teamCell(plan, s.of.team),
        cell(s.runs),
        numberCell(100 * static_cast<double>(s.found) / static_cast<double>(s.runs), 1),
        fixed(100 * s.success.low, 0) + " to " + fixed(100 * s.success.high, 0),
        numberCell(s.median_s, 1),
        secondsText(s.median_interval_s.low) + " to " + secondsText(s.median_interval_s.high),
        numberCell(s.quantile90_s, 1),
        optionalCell(s.competitive_ratio, 2),
        optionalCell(s.speed_up, 2),
        numberCell(s.driven_m, 1),
        numberCell(s.energy_wh, 2),
        numberCell(s.messages, 0),
        numberCell(s.message_bytes, 0),
        numberCell(100 * s.overlap, 1),
        numberCell(s.stalls, 1)};
    for (const auto& metric : s.metrics) cells.push_back(numberCell(metric.value, 2));
    table.add(cells);
  }
  return table.html();
}

std::string comparisonsTable(const SearchPlan& plan, std::span<const StrategyComparison> comparisons,
                             std::size_t condition) {
  HtmlTable table({"first : second", "robots", "first faster", "second faster", "ties", "p", "p (Holm)"}, true);
  const auto name = [&](std::size_t strategy, bool is_sure) {
    const std::string text = escapedHtml(plan.strategyName(strategy));
    return is_sure ? "<b class=sure>" + text + "</b>" : text;
  };
  for (const auto& c : comparisons) {
    if (c.condition != condition) continue;
    const PairedComparison& r = c.result;
    const bool is_first = r.first_faster >= r.second_faster;
    const bool is_sure = c.adjusted_p < 0.05;
    table.add({name(c.first, is_sure && is_first) + " : " + name(c.second, is_sure && !is_first),
               teamCell(plan, c.team), cell(r.first_faster), cell(r.second_faster), cell(r.ties), probability(r.p),
               probability(c.adjusted_p)});
  }
  return table.html();
}

std::string robustnessTable(const SearchPlan& plan, std::span<const Robustness> all, std::size_t condition) {
  const std::string first = plan.conditions.front().text();
  HtmlTable table({"strategy", "robots", "success, " + first + " [%]", "success [%]",
                   "median of time relative to " + first, "p", "p (Holm)"},
                  true);
  for (const auto& r : all) {
    if (r.condition != condition) continue;
    const auto n = static_cast<double>(r.runs);
    table.add({escapedHtml(plan.strategyName(r.strategy)), teamCell(plan, r.team),
               numberCell(100 * static_cast<double>(r.found_at_first) / n, 1),
               numberCell(100 * static_cast<double>(r.found) / n, 1), numberCell(r.median_ratio, 2),
               probability(r.result.p), probability(r.adjusted_p)});
  }
  return table.html();
}

}  // namespace robosim
