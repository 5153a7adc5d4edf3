#include "benchmark/search_report.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "benchmark/search_figures.h"
#include "replay/csv_field.h"
#include "run/json_text.h"

namespace robosim {
namespace {

void writeFile(const std::filesystem::path& file, const std::string& content) {
  AtomicFile out(file);
  out.write(content);
  out.commit();
}

std::string orEmpty(const std::optional<double>& value) { return value ? toText(*value) : ""; }
std::string numberOrEmpty(double value) { return std::isfinite(value) ? toText(value) : ""; }

std::vector<std::string> metricNames(const SearchRuns& runs) {
  std::vector<std::string> names;
  for (const auto& run : runs) {
    if (!run) continue;
    for (const auto& metric : run->metrics) names.push_back(metric.name);
    break;
  }
  return names;
}

}  // namespace

std::string runsCsv(const SearchPlan& plan, const SearchRuns& runs) {
  std::string csv =
      "world,controller,seed,condition,robots,gold_found,gold_found_by,gold_time_s,all_halted_time_s,sim_time_s,ended_"
      "by,"
      "driven_m,stalls,messages_sent,messages,messages_lost";
  const auto metrics = metricNames(runs);
  for (const auto& name : metrics) csv += "," + name;
  csv += ",digest\n";
  for (const auto& run : runs) {
    if (!run) continue;
    const SearchPlan::Case c = plan.caseAt(run->case_index);
    csv += csvField(plan.worlds[c.world]) + "," + csvField(plan.strategies[c.strategy]) + "," +
           std::to_string(run->seed) + "," + csvField(plan.conditions[c.condition].text()) + "," +
           std::to_string(run->robots) + "," + (run->found_s ? "1" : "0") + "," + csvField(run->found_by.value_or("")) +
           "," + orEmpty(run->found_s) + "," + orEmpty(run->all_halted_s) + "," + toText(run->sim_time_s) + "," +
           run->ended_by + "," + toText(run->driven_m) + "," + std::to_string(run->stalls) + "," +
           std::to_string(run->messages_sent) + "," + std::to_string(run->messages_delivered) + "," +
           std::to_string(run->messages_lost);
    for (const auto& name : metrics) csv += "," + numberOrEmpty(run->metric(name));
    csv += "," + run->digest + "\n";
  }
  return csv;
}

std::string runsJson(const SearchPlan& plan, const SearchRuns& runs, const std::string& command) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& run : runs) {
    if (!run) continue;
    const SearchPlan::Case c = plan.caseAt(run->case_index);
    nlohmann::ordered_json json{{"world", plan.worlds[c.world]},
                                {"condition", plan.conditions[c.condition].text()},
                                {"controller", plan.strategies[c.strategy]}};
    json.update(run->json());
    json.erase("case");
    all.push_back(std::move(json));
  }
  return jsonText({{"robosim_version", ROBOSIM_VERSION},
                   {"command", command},
                   {"plan", plan.json()},
                   {"runs", std::move(all)}}) +
         "\n";
}

std::string comparisonsCsv(const SearchPlan& plan, const SearchRuns& runs) {
  std::string csv = "world,condition,team,first,second,first_faster,second_faster,ties,p,holm_p\n";
  for (const bool by_world : {false, true}) {
    for (const auto& comparison : compareStrategies(plan, runs, by_world)) {
      const PairedComparison& result = comparison.result;
      csv += (comparison.world ? csvField(plan.worlds[*comparison.world]) : "all") + "," +
             csvField(plan.conditions[comparison.condition].text()) + "," +
             std::to_string(plan.teams[comparison.team]) + "," + csvField(plan.strategyName(comparison.first)) + "," +
             csvField(plan.strategyName(comparison.second)) + "," + std::to_string(result.first_faster) + "," +
             std::to_string(result.second_faster) + "," + std::to_string(result.ties) + "," + toText(result.p) + "," +
             toText(comparison.adjusted_p) + "\n";
    }
  }
  return csv;
}

std::vector<RunPageLink> chooseRuns(const SearchPlan& plan, const SearchRuns& runs, std::size_t count) {
  std::vector<RunPageLink> chosen;
  for (std::size_t strategy = 0; strategy < plan.strategies.size(); ++strategy) {
    std::vector<std::pair<double, std::size_t>> by_time;  // and index
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!runs[i] || plan.caseAt(runs[i]->case_index).strategy != strategy) continue;
      by_time.emplace_back(runs[i]->found_s.value_or(std::numeric_limits<double>::infinity()), i);
    }
    std::sort(by_time.begin(), by_time.end());
    const std::size_t of_strategy = std::min(count, by_time.size());
    std::string name = plan.strategies[strategy].empty() ? "world" : plan.strategies[strategy];
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_' && c != '-'; }, '_');
    for (std::size_t k = 0; k < of_strategy; ++k) {
      const std::size_t at = of_strategy == 1 ? 0 : k * (by_time.size() - 1) / (of_strategy - 1);
      const std::size_t run = by_time[at].second;
      chosen.push_back({run, "runs/" + name + "-" + std::to_string(run) + ".html"});
    }
  }
  return chosen;
}

void writeReportData(const std::filesystem::path& folder, const SearchPlan& plan, const SearchRuns& runs,
                     const std::string& command) {
  const std::filesystem::path figures = folder / "figures";
  std::error_code error;
  std::filesystem::create_directories(figures, error);
  if (error) throw ConfigError(figures.string() + ": cannot be created: " + error.message());
  const auto summaries = summarise(plan, runs);
  for (const auto& list : {survivalFigures(plan, summaries), speedUpFigures(plan, summaries)}) {
    for (const auto& figure : list) {
      writeFile(figures / (figure.name + ".svg"), svgOf(figure.chart, ChartColors::fixed));
      writeFile(figures / (figure.name + ".pdf"), drawPdf(figure.chart));
    }
  }
  writeFile(folder / "runs.csv", runsCsv(plan, runs));
  writeFile(folder / "runs.json", runsJson(plan, runs, command));
  writeFile(folder / "comparisons.csv", comparisonsCsv(plan, runs));
}

void writeReportPage(const std::filesystem::path& folder, const SearchPlan& plan, const SearchRuns& runs,
                     const std::string& command, const std::vector<RunPageLink>& pages) {
  writeFile(folder / "index.html", reportHtml(plan, runs, command, pages));
}

}  // namespace robosim
