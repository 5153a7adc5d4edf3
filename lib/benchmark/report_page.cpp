// The HTML page of a report.
#include <cmath>

#include "base/html_text.h"
#include "base/text_table.h"
#include "benchmark/search_figures.h"
#include "benchmark/search_report.h"

namespace robosim {
namespace {

constexpr const char* kStyle =
    "*{box-sizing:border-box}"
    ":root{color-scheme:light "
    "dark;--text:#222;--quiet:#5a6068;--line:#cfd4da;--back:#fff;--stripe:#f5f7f9;--good:#0a6b3d}"
    "@media(prefers-color-scheme:dark){:root{--text:#dfe3e8;--quiet:#9aa3ad;--line:#3b4148;--back:#15181c;"
    "--stripe:#1d2126;--good:#5fd39a}}"
    "body{font:15px/1.5 system-ui,sans-serif;margin:0 auto;max-width:100rem;padding:1.5rem;color:var(--text);"
    "background:var(--back)}"
    "h1{font-size:1.6rem;margin:0 0 .3rem}h2{margin:2.2rem 0 .6rem;font-size:1.25rem}h3{font-size:1.05rem}"
    "p{max-width:62rem}.quiet{color:var(--quiet)}"
    ".wide{overflow-x:auto}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums}"
    "th,td{padding:.25rem .6rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}"
    "th:first-child,td:first-child,.text{text-align:left}"
    "tbody tr:nth-child(even){background:var(--stripe)}"
    "th button{font:inherit;font-weight:600;color:inherit;background:none;border:0;padding:0;cursor:pointer}"
    "th button::after{content:' \\2195';color:var(--quiet)}"
    "th[aria-sort=ascending] button::after{content:' \\2191'}th[aria-sort=descending] button::after{content:' \\2193'}"
    "pre{background:var(--stripe);border:1px solid var(--line);border-radius:6px;padding:.8rem;overflow-x:auto;"
    "white-space:pre-wrap}"
    ".charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,36rem),1fr));gap:.5rem 1.5rem}"
    "summary{cursor:pointer;font-weight:600;padding:.3rem 0}svg{max-width:100%;height:auto;display:block;margin:.4rem "
    "0}"
    ".sure{color:var(--good);font-weight:600}";

constexpr const char* kScript =
    "for(const table of document.querySelectorAll('table.sortable')){"
    "[...table.tHead.rows[0].cells].forEach((cell,column)=>{"
    "const button=document.createElement('button');button.type='button';button.textContent=cell.textContent;"
    "cell.replaceChildren(button);"
    "button.addEventListener('click',()=>{"
    "const falling=cell.getAttribute('aria-sort')==='ascending';"
    "for(const other of table.tHead.rows[0].cells)other.removeAttribute('aria-sort');"
    "cell.setAttribute('aria-sort',falling?'descending':'ascending');"
    "const value=row=>{const c=row.cells[column];const v=c.dataset.value;return v===undefined?c.textContent:"
    "v==='inf'?Infinity:Number(v)};"
    "const rows=[...table.tBodies[0].rows];"
    "rows.sort((a,b)=>{const x=value(a),y=value(b);const d=x<y?-1:x>y?1:0;return falling?-d:d});"
    "table.tBodies[0].append(...rows)})})}";

struct Cell {
  std::string text;
  std::optional<double> value;  ///< by which it is sorted; nullopt: by its text
  bool is_sure = false;         ///< emphasised
};

std::string rowOf(const std::vector<Cell>& cells) {
  std::string row = "<tr>";
  for (const auto& cell : cells) {
    row += "<td";
    if (cell.value) {
      row += " data-value=\"" + (std::isfinite(*cell.value) ? fixed(*cell.value, 6) : std::string("inf")) + "\"";
    } else {
      row += " class=\"text\"";
    }
    row += cell.is_sure ? "><span class=\"sure\">" + escapedHtml(cell.text) + "</span></td>"
                        : ">" + escapedHtml(cell.text) + "</td>";
  }
  return row + "</tr>\n";
}

/// @param header beginning with '<' for a column of texts
std::string tableOf(const std::vector<std::string>& header, const std::string& rows) {
  std::string html = "<div class=\"wide\" tabindex=\"0\"><table class=\"sortable\"><thead><tr>";
  for (const auto& name : header) {
    const bool is_text = name.starts_with('<');
    html += std::string("<th scope=\"col\"") + (is_text ? " class=\"text\">" : ">") +
            escapedHtml(is_text ? name.substr(1) : name) + "</th>";
  }
  return html + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

Cell number(double value, int decimals) {
  if (std::isnan(value)) return {"–", -1.0};
  return {std::isfinite(value) ? fixed(value, decimals) : "never", value};
}

Cell optional(const std::optional<double>& value, int decimals) {
  return value ? number(*value, decimals) : Cell{"–", -1.0};
}

std::string seconds(double value) { return std::isfinite(value) ? fixed(value, 1) : "never"; }

std::string resultsOf(const SearchPlan& plan, const std::vector<CaseSummary>& summaries) {
  std::vector<std::string> header{"<world",       "<condition",    "robots",     "<strategy",         "runs",
                                  "success [%]",  "95 % interval", "median [s]", "95 % interval [s]", "90 % [s]",
                                  "times oracle", "speed-up",      "driven [m]", "energy [Wh]",       "messages",
                                  "bytes",        "overlap [%]",   "stalls"};
  if (!summaries.empty()) {
    for (const auto& metric : summaries.front().metrics) header.push_back(metric.name);
  }
  std::string rows;
  for (const auto& s : summaries) {
    const double share = 100 * static_cast<double>(s.found) / static_cast<double>(s.runs);
    const int team = plan.teams[s.of.team];
    std::vector<Cell> cells{
        {plan.worlds[s.of.world], {}},
        {plan.conditions[s.of.condition].text(), {}},
        {team == 0 ? "its own" : std::to_string(team), static_cast<double>(team)},
        {plan.strategyName(s.of.strategy), {}},
        number(static_cast<double>(s.runs), 0),
        number(share, 1),
        {fixed(100 * s.success.low, 0) + " to " + fixed(100 * s.success.high, 0), s.success.low},
        number(s.median_s, 1),
        {seconds(s.median_interval_s.low) + " to " + seconds(s.median_interval_s.high), s.median_interval_s.low},
        number(s.quantile90_s, 1),
        optional(s.competitive_ratio, 2),
        optional(s.speed_up, 2),
        number(s.driven_m, 1),
        number(s.energy_wh, 2),
        number(s.messages, 0),
        number(s.message_bytes, 0),
        number(100 * s.overlap, 1),
        number(s.stalls, 1)};
    for (const auto& metric : s.metrics) cells.push_back(number(metric.value, 2));
    rows += rowOf(cells);
  }
  return tableOf(header, rows);
}

/// Below 0.001 with two digits; else three decimals.
std::string probability(double p) {
  if (p >= 0.001) return fixed(p, 3);
  return p < 1e-6 ? "< 0.000001" : fixed(p, 6);
}

std::string comparisonsOf(const SearchPlan& plan, const SearchRuns& runs) {
  std::string rows;
  for (const auto& c : compareStrategies(plan, runs, false)) {
    const PairedComparison& r = c.result;
    const bool is_first = r.first_faster >= r.second_faster;
    const bool is_sure = c.adjusted_p < 0.05;
    rows += rowOf({{plan.conditions[c.condition].text(), {}},
                   {plan.teams[c.team] == 0 ? "its own" : std::to_string(plan.teams[c.team]),
                    static_cast<double>(plan.teams[c.team])},
                   {plan.strategyName(c.first), {}, is_sure && is_first},
                   {plan.strategyName(c.second), {}, is_sure && !is_first},
                   number(static_cast<double>(r.first_faster), 0),
                   number(static_cast<double>(r.second_faster), 0),
                   number(static_cast<double>(r.ties), 0),
                   {probability(r.p), r.p},
                   {probability(c.adjusted_p), c.adjusted_p}});
  }
  return tableOf(
      {"<condition", "robots", "<first", "<second", "first faster", "second faster", "ties", "p", "p (Holm)"}, rows);
}

std::string robustnessTable(const SearchPlan& plan, const SearchRuns& runs) {
  std::string rows;
  for (const auto& r : robustnessOf(plan, runs)) {
    const auto n = static_cast<double>(r.runs);
    rows += rowOf({{plan.conditions[r.condition].text(), {}},
                   {plan.teams[r.team] == 0 ? "its own" : std::to_string(plan.teams[r.team]),
                    static_cast<double>(plan.teams[r.team])},
                   {plan.strategyName(r.strategy), {}},
                   number(100 * static_cast<double>(r.found_at_first) / n, 1),
                   number(100 * static_cast<double>(r.found) / n, 1),
                   number(r.median_ratio, 2),
                   {probability(r.result.p), r.result.p},
                   {probability(r.adjusted_p), r.adjusted_p}});
  }
  const std::string first = plan.conditions.front().text();
  return tableOf({"<condition", "robots", "<strategy", "success, " + first + " [%]", "success [%]",
                  "median of time relative to " + first, "p", "p (Holm)"},
                 rows);
}

std::string figuresOf(const SearchPlan& plan, const std::vector<SearchFigure>& figures) {
  std::string html;
  for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
    std::string of_world;
    for (const auto& figure : figures) {
      if (figure.world == world) of_world += svgOf(figure.chart, ChartColors::page);
    }
    if (of_world.empty()) continue;
    html += std::string("<details") + (world == 0 ? " open" : "") + "><summary>" + escapedHtml(plan.worlds[world]) +
            "</summary>\n<div class=\"charts\">" + of_world + "</div></details>\n";
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
    "<p><b>Times oracle</b> is the competitive ratio: the median, over the starts, of the time relative to that of a "
    "robot that knows the map and the gold, from the same start. <b>Speed-up</b> is the median time of the smallest "
    "team divided by that of this team. <b>Energy</b> and <b>driven</b> are of all robots, until the end of the run. "
    "<b>Overlap</b> is the share of visits of a cell of 0.5&nbsp;m that another robot had made or makes as well.</p>\n"
    "<p><b>Comparisons</b> are paired: both strategies search from the same starts with the same seeds. The sign test "
    "counts who was first, which is exact also for censored runs; p values are two-sided, and Holm’s (1979) are "
    "adjusted for the number of lines in the table. A name in green was faster at a level of 5&nbsp;%.</p>\n";

}  // namespace

std::string reportHtml(const SearchPlan& plan, const SearchRuns& runs, const std::string& command) {
  const auto summaries = summarise(plan, runs);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>Gold benchmark</title>\n<style>" +
      std::string(kStyle) + chartStyle() +
      "</style>\n</head>\n<body>\n<main>\n<h1>Gold benchmark</h1>\n<p class=\"quiet\">" +
      escapedHtml(summaryLine(plan, runs)) + "</p>\n<pre>" + escapedHtml(command) + "</pre>\n<h2>Results</h2>\n" +
      resultsOf(plan, summaries);
  html += "<h2>Share of runs still searching</h2>\n" + figuresOf(plan, survivalFigures(plan, summaries));
  if (plan.teams.size() > 1) html += "<h2>Speed-up</h2>\n" + figuresOf(plan, speedUpFigures(plan, summaries));
  if (plan.strategies.size() > 1) {
    html +=
        "<h2>Strategies compared</h2>\n<p class=\"quiet\">All worlds together; comparisons.csv has each world.</p>\n" +
        comparisonsOf(plan, runs);
  }
  if (plan.conditions.size() > 1) html += "<h2>Robustness</h2>\n" + robustnessTable(plan, runs);
  return html + kMethods + "</main>\n<script>" + kScript + "</script>\n</body>\n</html>\n";
}

}  // namespace robosim
