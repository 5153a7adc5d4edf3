#include "benchmark/search_figures.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

std::string fileName(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool is_kept = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.';
    if (is_kept) {
      name += c;
    } else if (!name.ends_with('_')) {
      name += '_';
    }
  }
  return name;
}

/// ", noise" if the plan has several conditions, or another than ideal.
std::string conditionSuffix(const SearchPlan& plan, std::size_t condition) {
  const bool is_plain = plan.conditions.size() == 1 && plan.conditions.front() == Condition{};
  return is_plain ? "" : ", " + plan.conditions[condition].text();
}

std::string teamSuffix(const SearchPlan& plan, std::size_t team) {
  return plan.teams.size() == 1 && plan.teams.front() == 0 ? "" : ", " + plan.teamName(team);
}

ChartSeries survivalSeries(const SearchPlan& plan, const CaseSummary& summary) {
  ChartSeries series;
  series.name = plan.strategyName(summary.of.strategy);
  series.is_step = true;
  const auto add = [&](double time_s, const SurvivalStep& step) {
    series.points.push_back({time_s, step.searching});
    series.low.push_back(step.low);
    series.high.push_back(step.high);
  };
  add(0, {});
  for (const auto& step : summary.survival) add(step.time_s, step);
  // A censored search continues until the limit.
  const double end_s =
      summary.found == summary.runs && !summary.survival.empty() ? summary.survival.back().time_s : plan.time_s;
  add(std::max(end_s, series.points.back().x), summary.survival.empty() ? SurvivalStep{} : summary.survival.back());
  return series;
}

}  // namespace

std::vector<SearchFigure> survivalFigures(const SearchPlan& plan, std::span<const CaseSummary> summaries) {
  std::vector<SearchFigure> figures;
  for (std::size_t i = 0; i < summaries.size();) {
    const SearchPlan::Case of = summaries[i].of;
    const auto is_same = [&](const SearchPlan::Case& c) {
      return c.world == of.world && c.condition == of.condition && c.team == of.team;
    };
    Chart chart;
    chart.title = plan.worlds[of.world] + teamSuffix(plan, of.team) + conditionSuffix(plan, of.condition);
    chart.x_label = "simulated time [s]";
    chart.y_label = "share of runs still searching";
    chart.x_max = 1;
    for (; i < summaries.size() && is_same(summaries[i].of); ++i) {
      chart.series.push_back(survivalSeries(plan, summaries[i]));
      for (const auto& step : summaries[i].survival) chart.x_max = std::max(chart.x_max, 1.05 * step.time_s);
      if (summaries[i].found < summaries[i].runs) chart.x_max = std::max(chart.x_max, plan.time_s);
    }
    figures.push_back({"survival_" + fileName(chart.title), of.world, std::move(chart)});
  }
  return figures;
}

std::vector<SearchFigure> speedUpFigures(const SearchPlan& plan, std::span<const CaseSummary> summaries) {
  std::vector<SearchFigure> figures;
  if (plan.teams.size() < 2) return figures;
  const auto [smallest, largest] = std::minmax_element(plan.teams.begin(), plan.teams.end());
  for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
    for (std::size_t condition = 0; condition < plan.conditions.size(); ++condition) {
      Chart chart;
      chart.title = plan.worlds[world] + conditionSuffix(plan, condition);
      chart.x_label = "robots";
      chart.y_label = "speed-up of the median time to the gold";
      // Both logarithmic: a linear speed-up is a straight line.
      chart.is_x_log2 = chart.is_y_log2 = true;
      chart.x_min = *smallest;
      chart.x_max = *largest;
      double least = 1, most = 1;
      for (std::size_t strategy = 0; strategy < plan.strategies.size(); ++strategy) {
        ChartSeries series;
        series.name = plan.strategyName(strategy);
        for (const auto& summary : summaries) {
          const bool is_this =
              summary.of.world == world && summary.of.condition == condition && summary.of.strategy == strategy;
          if (!is_this || !summary.speed_up) continue;
          series.points.push_back({static_cast<double>(plan.teams[summary.of.team]), *summary.speed_up});
          least = std::min(least, *summary.speed_up);
          most = std::max(most, *summary.speed_up);
        }
        std::sort(series.points.begin(), series.points.end(),
                  [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
        chart.series.push_back(std::move(series));
      }
      chart.y_min = std::exp2(std::floor(std::log2(least)));
      chart.y_max = std::exp2(std::max(1.0, std::ceil(std::log2(most))));
      ChartSeries linear;
      linear.name = "linear";
      linear.is_reference = true;
      const double last = std::min(chart.x_max, chart.y_max * chart.x_min);
      linear.points = {{chart.x_min, 1}, {last, last / chart.x_min}};
      chart.series.push_back(std::move(linear));
      figures.push_back({"speed_up_" + fileName(chart.title), world, std::move(chart)});
    }
  }
  return figures;
}

}  // namespace robosim
