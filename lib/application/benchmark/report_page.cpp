// The HTML page of a report.
#include "base/report_page.h"

#include "base/html_text.h"
#include "base/text_table.h"
#include "benchmark/report_tables.h"
#include "benchmark/search_figures.h"
#include "benchmark/search_report.h"

namespace robosim {
namespace {

std::string folded(const std::string& title, const std::string& content, bool is_open) {
  return std::string("<details") + (is_open ? " open" : "") + "><summary>" + escapedHtml(title) + "</summary>\n" +
         content + "</details>\n";
}

/// A heading above each condition's table if there are several.
std::string conditionHeading(const SearchPlan& plan, std::size_t condition) {
  return plan.conditions.size() == 1 ? "" : "<h3>" + escapedHtml(plan.conditions[condition].text()) + "</h3>\n";
}

std::string makeCharts(std::span<const SearchFigure> figures, std::size_t world) {
  std::string charts;
  for (const auto& figure : figures) {
    if (figure.world == world) charts += svgOf(figure.chart, ChartColors::page);
  }
  return charts.empty() ? "" : "<div class=charts tabindex=0>\n" + charts + "</div>\n";
}

std::string makeOverview(const SearchPlan& plan, const SearchRuns& runs) {
  std::string html = "<h2>All worlds</h2>\n";
  for (std::size_t condition = 0; condition < plan.conditions.size(); ++condition) {
    html += conditionHeading(plan, condition) + overviewTable(plan, runs, condition);
  }
  return html;
}

std::string worldsOf(const SearchPlan& plan, std::span<const CaseSummary> summaries) {
  const auto survival = survivalFigures(plan, summaries);
  const auto speed_up = speedUpFigures(plan, summaries);
  std::string html = "<h2>Each world</h2>\n";
  for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
    std::string of_world = makeCharts(survival, world) + makeCharts(speed_up, world);
    for (std::size_t condition = 0; condition < plan.conditions.size(); ++condition) {
      of_world += conditionHeading(plan, condition) + resultsTable(plan, summaries, world, condition);
    }
    html += folded(plan.worlds[world], of_world, world == 0);
  }
  return html;
}

std::string runLinks(const SearchPlan& plan, const SearchRuns& runs, const std::vector<RunPageLink>& pages) {
  if (pages.empty()) return "";
  std::string html =
      "<h2>Runs to watch</h2>\n<div class=wide tabindex=0><table><thead><tr><th>run</th><th>result</th>"
      "<th>driven [m]</th><th>stalls</th></tr></thead><tbody>\n";
  for (const auto& page : pages) {
    const SearchRun& run = *runs[page.run];
    html += "<tr><th><a href=\"" + escapedHtml(page.file) + "\">" +
            escapedHtml(plan.caseName(plan.caseAt(run.case_index)) + ", seed " + std::to_string(run.seed)) +
            "</a></th><td>" + (run.found_s ? fixed(*run.found_s, 1) + " s" : "never") + "</td><td>" +
            fixed(run.driven_m, 1) + "</td><td>" + withCommas(run.stalls) + "</td></tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string makeComparisons(const SearchPlan& plan, const SearchRuns& runs) {
  if (plan.strategies.size() < 2) return "";
  std::string html =
      "<h2>Strategies compared</h2>\n<p class=quiet>All worlds together; comparisons.csv has each world.</p>\n";
  const auto comparisons = compareStrategies(plan, runs, false);
  for (std::size_t condition = 0; condition < plan.conditions.size(); ++condition) {
    html += folded(plan.conditions[condition].text(), comparisonsTable(plan, comparisons, condition), condition == 0);
  }
  return html;
}

std::string robustnessSection(const SearchPlan& plan, const SearchRuns& runs) {
  if (plan.conditions.size() < 2) return "";
  std::string html = "<h2>Robustness</h2>\n";
  const auto all = computeRobustness(plan, runs);
  for (std::size_t condition = 1; condition < plan.conditions.size(); ++condition) {
    html += folded(plan.conditions[condition].text(), robustnessTable(plan, all, condition), condition == 1);
  }
  return html;
}

std::string summaryLine(const SearchPlan& plan, const SearchRuns& runs) {
  const std::size_t done = runs.size() - missing(runs).size();
  std::string text =
      withCommas(done) + " runs: " + std::to_string(plan.worlds.size()) +
      (plan.worlds.size() == 1 ? " world, " : " worlds, ") + std::to_string(plan.strategies.size()) +
      (plan.strategies.size() == 1 ? " strategy, " : " strategies, ") + std::to_string(plan.teams.size()) +
      (plan.teams.size() == 1 ? " team, " : " sizes of teams, ") + std::to_string(plan.conditions.size()) +
      (plan.conditions.size() == 1 ? " condition, " : " conditions, ") + "seeds " + std::to_string(plan.seed) + " to " +
      std::to_string(plan.seed + plan.runs - 1) + ", simulated time limit " + fixed(plan.time_s, 0) + " s.";
  if (done < runs.size()) text += " " + withCommas(runs.size() - done) + " of the planned runs are missing.";
  return text;
}

constexpr const char* kMethods =
    "<h2>How to read this</h2>\n"
    "<p><b>Time to the gold</b> is simulated time from the start until a robot measures the gold’s heat. A run that "
    "reaches its time limit is censored: its time is longer than the limit, by an unknown amount. Medians and the "
    "share of runs that still search are therefore those of Kaplan and Meier (1958), with bands of 95&nbsp;% by "
    "Greenwood’s variance on the scale log(−log). Intervals of medians are percentiles of 2,000 bootstrap samples; "
    "“never” means beyond the limit. Intervals of shares are Wilson’s (1927).</p>\n"
    "<p><b>All worlds</b>: the shares and medians of the first tables are of the runs in all worlds together. Bold "
    "figures are the best of a column, beside the oracle’s.</p>\n"
    "<p><b>Times oracle</b> is the competitive ratio: the median, over the starts, of the time relative to that of a "
    "robot that knows the map and the gold, from the same start. <b>Speed-up</b> is the median time of the smallest "
    "team divided by that of this team. <b>Energy</b> and <b>driven</b> are of all robots, until the end of the run. "
    "<b>Overlap</b> is the share of visits of a cell of 0.5&nbsp;m that another robot had made or makes as well.</p>\n"
    "<p><b>Comparisons</b> are paired: both strategies search from the same starts with the same seeds. The sign test "
    "counts who was first, which is exact also for censored runs; p values are two-sided, and Holm’s (1979) are "
    "adjusted for the number of lines in the table. A name in green was faster at a level of 5&nbsp;%.</p>\n";

}  // namespace

std::string reportHtml(const SearchPlan& plan, const SearchRuns& runs, const std::string& command,
                       const std::vector<RunPageLink>& pages) {
  return reportPage("Gold benchmark",
                    "<p class=\"quiet\">" + escapedHtml(summaryLine(plan, runs)) + "</p>\n<pre>" +
                        escapedHtml(command) + "</pre>\n" + makeOverview(plan, runs) +
                        worldsOf(plan, summarise(plan, runs)) + runLinks(plan, runs, pages) +
                        makeComparisons(plan, runs) + robustnessSection(plan, runs) + kMethods,
                    chartStyle());
}

}  // namespace robosim
