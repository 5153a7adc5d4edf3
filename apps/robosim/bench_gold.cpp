// robosim bench gold: success and time of finding gold, over worlds, controllers, teams, conditions and seeds.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "base/atomic_file.h"
#include "base/data_folders.h"
#include "base/interrupt.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "base/type_choice.h"
#include "base/xml_element.h"
#include "benchmark/case_summary.h"
#include "benchmark/journal.h"
#include "benchmark/search_benchmark.h"
#include "benchmark/search_report.h"
#include "distributed/ranks/agreement.h"
#include "distributed/ranks/tasks_on_ranks.h"
#include "robosim/arguments.h"
#include "robosim/bench_arguments.h"
#include "robosim/bench_runs.h"
#include "robosim/command_line.h"
#include "robosim/plugin_options.h"
#include "run/output_files.h"
#include "run/run_observers.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRunsMax = 10'000'000;
constexpr std::size_t kDefaultPages = 2, kPagesMax = 1000;

struct GoldArguments {
  std::vector<std::string> files;
  WorldChanges changes;
  std::vector<std::string> robots;       ///< of `changes`, as given: their headings in degrees
  std::vector<std::string> controllers;  ///< may have lists of values
  std::vector<int> teams;
  std::vector<std::string> conditions;
  int runs = 20;
  SearchPlan plan;  ///< without worlds
  int threads = 1;
  std::string csv;
  std::string report;  ///< folder; empty: none
  bool resume = false;
  std::size_t pages = kDefaultPages;  ///< of each strategy
};

/// A word of a command for a shell.
std::string quoted(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// What finds a world's file from any folder, if it is a shipped one; else its path.
std::string worldArgument(const std::string& file, const std::string& name) {
  std::error_code none;
  const auto found = findDataFile(name);
  return found && fs::equivalent(*found, file, none) ? name : file;
}

/// The command that makes the same report, on one line.
std::string describeCommand(const GoldArguments& arguments, const SearchPlan& plan) {
  std::string command = "robosim bench gold";
  const auto add = [&](const std::string& option, const std::string& value) {
    command += " " + option + " " + quoted(value);
  };
  for (std::size_t i = 0; i < arguments.files.size(); ++i)
    command += " " + quoted(worldArgument(arguments.files[i], plan.worlds[i]));
  for (const auto& file : pluginArguments()) add("--plugin", file);
  for (const auto& robot : arguments.robots) add("--robot", robot);
  if (arguments.changes.random_robots > 0) {
    add("--random-robots", std::to_string(arguments.changes.random_robots) + "," + arguments.changes.random_model);
  }
  if (arguments.changes.start_distance_m) add("--start-distance", toText(*arguments.changes.start_distance_m));
  const AddedNoise noise = arguments.changes.noise;
  if (noise != AddedNoise::none) add("--noise", noise == AddedNoise::all ? "all" : "on");
  for (const auto& strategy : plan.strategies) {
    if (!strategy.empty()) add("--controller", strategy);
  }
  std::string teams;
  for (const int team : arguments.teams) teams += (teams.empty() ? "" : ",") + std::to_string(team);
  if (!teams.empty()) add("--team", teams);
  for (const auto& condition : arguments.conditions) add("--condition", condition);
  for (const auto& observer : plan.observers) add("--observer", observer);
  add("--runs", std::to_string(plan.runs));
  add("--seed", std::to_string(plan.seed));
  add("--time", toText(plan.time_s));
  add("--step", toText(plan.period_s));
  if (arguments.pages != kDefaultPages) add("--pages", std::to_string(arguments.pages));
  add("--report", "FOLDER");
  return command;
}

std::string secondsOrNever(double seconds) { return std::isfinite(seconds) ? fixed(seconds, 1) : "never"; }

std::vector<std::string> header(const SearchPlan& plan, const std::vector<Metric>& metrics) {
  std::vector<std::string> cells{"world"};
  if (plan.conditions.size() > 1) cells.emplace_back("condition");
  if (plan.teams.size() > 1) cells.emplace_back("robots");
  if (plan.strategies.size() > 1) cells.emplace_back("controller");
  cells.insert(cells.end(), {"runs", "found", "success", "median [s]", "90 % [s]", "driven [m]", "stalls"});
  for (const auto& metric : metrics) cells.push_back(metric.name);
  return cells;
}

std::vector<std::string> row(const SearchPlan& plan, const CaseSummary& summary) {
  std::vector<std::string> cells{plan.worlds[summary.of.world]};
  if (plan.conditions.size() > 1) cells.push_back(plan.conditions[summary.of.condition].text());
  if (plan.teams.size() > 1) cells.push_back(std::to_string(plan.teams[summary.of.team]));
  if (plan.strategies.size() > 1) cells.push_back(plan.strategyName(summary.of.strategy));
  const double share = static_cast<double>(summary.found) / static_cast<double>(summary.runs);
  cells.insert(cells.end(), {std::to_string(summary.runs), std::to_string(summary.found), fixed(100 * share, 1) + " %",
                             secondsOrNever(summary.median_s), secondsOrNever(summary.quantile90_s),
                             fixed(summary.driven_m, 1), fixed(summary.stalls, 1)});
  for (const auto& metric : summary.metrics) {
    cells.push_back(std::isfinite(metric.value) ? fixed(metric.value, 2) : "–");
  }
  return cells;
}

void printTable(const SearchPlan& plan, const SearchRuns& runs) {
  const auto summaries = summarise(plan, runs);
  const std::vector<Metric> metrics = summaries.empty() ? std::vector<Metric>() : summaries.front().metrics;
  Rows rows{header(plan, metrics)};
  for (const auto& summary : summaries) rows.push_back(row(plan, summary));
  std::cout
      << table(rows)
      << "Times to the gold are simulated; \"never\" is beyond the time limit. Distance and stalls: all robots of "
         "a run.";
  if (!metrics.empty()) {
    std::cout << " Metrics: mean over the runs; \"–\": a time that some runs have not, of which robosim bench metrics "
              << "states the quantiles.";
  }
  std::cout << '\n';
}

/// Creates the folder of a report, and its journal, with whose runs it begins.
std::unique_ptr<Journal> openJournal(const GoldArguments& arguments, const SearchPlan& plan, SearchRuns& runs) {
  if (arguments.report.empty()) return nullptr;
  std::error_code error;
  fs::create_directories(arguments.report, error);
  if (error) throw ConfigError(arguments.report + ": cannot be created: " + error.message());
  const auto mode = arguments.resume ? Journal::Mode::resume : Journal::Mode::create;
  return std::make_unique<Journal>(fs::path(arguments.report) / "journal.jsonl", plan, mode,
                                   [&](std::size_t index, SearchRun run) { runs[index] = std::move(run); });
}

/// @throws Interrupted
void writePages(const GoldArguments& arguments, const SearchBenchmark& benchmark, const std::vector<RunPageLink>& pages,
                const Interrupt& interrupt) {
  if (pages.empty()) return;
  std::error_code error;
  fs::create_directories(fs::path(arguments.report) / "runs", error);
  std::size_t written = 0;
  Progress progress;
  for (const auto& page : pages) {
    if (progress.due()) {
      progress.show("pages of runs: " + std::to_string(written) + " of " + std::to_string(pages.size()) + " …");
    }
    if (!benchmark.writePage(page.run, fs::path(arguments.report) / page.file,
                             [&] { return interrupt.isRequested(); })) {
      throw Interrupted("interrupted after " + std::to_string(written) + " of " + std::to_string(pages.size()) +
                        " pages of runs; --resume makes the others, and then the report");
    }
    ++written;
  }
}

void bench(const GoldArguments& arguments) {
  RankGroup& group = rankGroup();
  refuseThreadsOnRanks(arguments.threads);
  const SearchBenchmark benchmark(arguments.plan, arguments.files, arguments.changes);
  if (!group.isFirst()) return helpFirstRank(benchmark);
  const SearchPlan& plan = benchmark.plan();
  warnOfPartialStep(plan.time_s, plan.period_s);
  const Interrupt interrupt;
  std::optional<AtomicFile> csv;
  SearchRuns runs;
  std::unique_ptr<Journal> journal;
  requireSamePlan(group, benchmark.planText());
  agree(group, [&] {
    if (plan.runCount() > kRunsMax) {
      throw ConfigError("these are " + withCommas(plan.runCount()) + " runs; 10,000,000 at most");
    }
    refuseOverwriting(benchmark.inputFiles(), {arguments.csv});
    for (const auto& file : arguments.files) refuseSameFile({{"WORLD", file}, {"--csv", arguments.csv}});
    // Opened before the runs, so that an invalid path is reported at once.
    if (!arguments.csv.empty()) csv.emplace(arguments.csv);
    runs.resize(plan.runCount());
    journal = openJournal(arguments, plan, runs);
  });
  makeBenchRuns(
      benchmark, arguments.threads, [&] { return interrupt.isRequested(); },
      [&](const SearchRun& run) {
        if (journal) journal->add(run);
      },
      runs);
  printTable(plan, runs);
  if (csv) {
    csv->write(runsCsv(plan, runs));
    csv->commit();
  }
  printBenchSpeed(plan.worlds, runs);
  if (const std::size_t left = missing(runs).size(); left > 0) {
    setFailureShared();  // the other ranks have ended
    throw Interrupted("interrupted; the figures are of the " + std::to_string(runs.size() - left) + " of " +
                      std::to_string(runs.size()) + " runs that were completed" +
                      (journal ? "; --resume makes the others, and then the report" : ""));
  }
  if (!journal) return;
  const std::string command = describeCommand(arguments, plan);
  writeReportData(arguments.report, plan, runs, command);
  const auto pages = chooseRuns(plan, runs, arguments.pages);
  writePages(arguments, benchmark, pages, interrupt);
  writeReportPage(arguments.report, plan, runs, command, pages);
  std::cout << "report  " << printableText((fs::path(arguments.report) / "index.html").string()) << '\n';
}

/// Completes the plan by what is checked after parsing. @throws ConfigError
void completePlan(GoldArguments& arguments) {
  SearchPlan& plan = arguments.plan;
  plan.strategies = allControllers(arguments.controllers);
  plan.runs = static_cast<std::size_t>(arguments.runs);
  if (!arguments.teams.empty()) plan.teams = arguments.teams;
  if (!arguments.conditions.empty()) plan.conditions.clear();
  for (const auto& text : arguments.conditions) plan.conditions.push_back(Condition::parse(text));
  const auto refuse_twice = [](auto values, const std::string& what) {
    std::sort(values.begin(), values.end());
    if (std::adjacent_find(values.begin(), values.end()) != values.end()) {
      throw ConfigError(what + " is given twice; keep one");
    }
  };
  refuse_twice(plan.teams, "a size of --team");
  refuse_twice(plan.strategies, "a controller");
  std::vector<std::string> conditions;
  for (const auto& condition : plan.conditions) conditions.push_back(condition.text());
  refuse_twice(conditions, "a --condition");
  for (const auto& observer : plan.observers) {
    if (TypeChoice::parse(observer, "observer").name == "effort") {
      throw ConfigError("--observer effort: bench gold always has it; remove the option");
    }
  }
}

}  // namespace

void addBenchGold(CLI::App& parent) {
  auto* command = parent.add_subcommand(
      "gold", "Measure success rate and time of finding gold, over many seeded runs, and report them");
  auto a = std::make_shared<GoldArguments>();
  command->add_option("WORLD", a->files, "world files")
      ->type_name("FILE")
      ->transform(inputFile(kWorldKinds))
      ->required();
  addRunsAndSeed(*command, a->runs, a->plan.seed);
  addThreads(*command, a->threads, "concurrent runs; the results do not depend on it");
  addTime(*command, a->plan.time_s, "simulated time limit of a run");
  addStep(*command, a->plan.period_s);
  addRobotOptions(*command, a->changes);
  addStartDistanceOption(*command, a->changes);
  addNoiseOption(*command, a->changes);
  addControllersOption(*command, a->controllers);
  command
      ->add_option("--team", a->teams,
                   "sizes of teams, as in 1,4,16: so many robots of the kind of the world's first one, at random "
                   "places, instead of its robots; 1 to 10000 each")
      ->delimiter(',')
      ->check(wholeNumberIn(1, 10000))
      ->type_name("NUMBER,…")
      ->allow_extra_args(false);
  command
      ->add_option("--condition", a->conditions,
                   "ideal, or noise or errors (as --noise on or all), loss=PROBABILITY (of messages) and "
                   "breakdown_s=SECONDS (mean "
                   "time until a robot breaks down), joined by '+'; repeatable, the first is compared with the others")
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  addObserverOption(*command, a->plan.observers, "add the metrics of this observer");
  command->add_option("--csv", a->csv, "also write one line per run to this file")
      ->type_name("FILE")
      ->check(fileName());
  command
      ->add_option("--report", a->report,
                   "write a report to this folder: index.html, figures, all runs, and a journal of finished runs")
      ->type_name("FOLDER")
      ->check(fileName());
  dependsOn(command->add_flag("--resume", a->resume, "continue the interrupted benchmark of the --report folder"),
            command->get_option("--report"));
  dependsOn(command
                ->add_option("--pages", a->pages,
                             "interactive pages of so many runs of each controller, to which the report has links: the "
                             "fastest, one that did not find the gold or else the slowest, and those in between")
                ->check(wholeNumberIn(0, kPagesMax))
                ->type_name("NUMBER")
                ->default_str(std::to_string(kDefaultPages)),
            command->get_option("--report"));
  setGroup(*command, kRunGroup, {"--runs", "--controller", "--team", "--condition", "--observer"});
  setGroup(*command, kWorldGroup, {"--seed"});
  setGroup(*command, kRecordingGroup, {"--csv", "--report", "--resume", "--pages"});
  command->callback([a, command] {
    a->robots = command->get_option("--robot")->results();
    completePlan(*a);
    bench(*a);
  });
}

}  // namespace robosim
