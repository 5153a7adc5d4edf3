// robosim bench metrics: tables of observers' metrics over worlds, controllers, parameters and seeds.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>

#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "benchmark/metric_summary.h"
#include "benchmark/sweep.h"
#include "distributed/ranks/agreement.h"
#include "distributed/ranks/tasks_on_ranks.h"
#include "replay/csv_field.h"
#include "robosim/arguments.h"
#include "robosim/bench_arguments.h"
#include "robosim/bench_runs.h"
#include "robosim/command_line.h"
#include "robosim/subcommands.h"
#include "run/output_files.h"
#include "run/run_summary.h"

namespace robosim {
namespace {

struct BenchArguments {
  std::vector<std::string> worlds;
  WorldChanges changes;
  SweepPlan plan;  ///< without worlds
  int runs = 20;
  int threads = 1;
  std::vector<std::string> controllers;  ///< may have lists of values
  std::string csv;
};

/// The finished runs of a case.
using CaseRuns = std::vector<const SearchRun*>;

std::vector<CaseRuns> byCase(const SweepPlan& plan, const SearchRuns& runs) {
  std::vector<CaseRuns> cases(plan.caseCount());
  for (const auto& run : runs) {
    if (run) cases[run->case_index].push_back(&*run);
  }
  return cases;
}

/// The first columns of a case.
std::vector<std::string> nameCells(const SweepPlan& plan, std::size_t index) {
  const SweepPlan::Case c = plan.caseAt(index);
  std::vector<std::string> cells{plan.worlds[c.world]};
  if (plan.controllers.size() > 1) {
    cells.push_back(plan.controllers[c.controller].empty() ? "of the world" : plan.controllers[c.controller]);
  }
  return cells;
}

std::vector<std::string> header(const SweepPlan& plan, std::vector<std::string> columns) {
  std::vector<std::string> cells{"world"};
  if (plan.controllers.size() > 1) cells.emplace_back("controller");
  cells.insert(cells.end(), columns.begin(), columns.end());
  return cells;
}

Rows runRows(const SweepPlan& plan, const std::vector<CaseRuns>& cases) {
  Rows rows{header(plan, {"runs", "all halted", "time limit", "observer", "driven [m]", "stalls"})};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].empty()) continue;
    const auto ended_by = [&](EndedBy why) {
      return std::to_string(std::count_if(cases[i].begin(), cases[i].end(),
                                          [why](const SearchRun* run) { return run->ended_by == nameOf(why); }));
    };
    double driven_m = 0, stalls = 0;
    for (const SearchRun* run : cases[i]) {
      driven_m += run->driven_m;
      stalls += static_cast<double>(run->stalls);
    }
    const auto n = static_cast<double>(cases[i].size());
    std::vector<std::string> cells = nameCells(plan, i);
    cells.insert(cells.end(),
                 {std::to_string(cases[i].size()), ended_by(EndedBy::all_halted), ended_by(EndedBy::time_limit),
                  ended_by(EndedBy::observer), fixed(driven_m / n, 1), fixed(stalls / n, 1)});
    rows.push_back(std::move(cells));
  }
  return rows;
}

std::string statisticText(double value) {
  return std::isnan(value) ? "–" : std::isfinite(value) ? fixed(value, 2) : "later";
}

std::vector<std::string> metricCells(const MetricSummary& summary) {
  const std::string deviation = std::isnan(summary.deviation) ? "" : " ± " + fixed(summary.deviation, 2);
  const std::string values = summary.values == summary.runs
                                 ? std::to_string(summary.runs)
                                 : std::to_string(summary.values) + " of " + std::to_string(summary.runs);
  return {summary.name,
          values,
          statisticText(summary.mean) + deviation,
          statisticText(summary.quantile10),
          statisticText(summary.median),
          statisticText(summary.median_interval.low) + " … " + statisticText(summary.median_interval.high),
          statisticText(summary.quantile90)};
}

/// One row for each metric of each case.
/// @param has_later set if a time lies beyond the ends of the runs
Rows metricRows(const SweepPlan& plan, const std::vector<CaseRuns>& cases, bool& has_later) {
  Rows rows{header(plan, {"metric", "values", "mean ± sd", "10 %", "median", "95 % interval", "90 %"})};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].empty()) continue;
    for (const auto& summary : summariseMetrics(cases[i], plan.time_s, plan.seed)) {
      has_later = has_later || (isTime(summary.name) && summary.values < summary.runs);
      std::vector<std::string> cells = nameCells(plan, i);
      for (auto& cell : metricCells(summary)) cells.push_back(std::move(cell));
      rows.push_back(std::move(cells));
    }
  }
  return rows;
}

void printTables(const SweepPlan& plan, const SearchRuns& runs) {
  const auto cases = byCase(plan, runs);
  bool has_later = false;
  const Rows metrics = metricRows(plan, cases, has_later);
  std::cout << table(runRows(plan, cases))
            << "Runs by what ended them. Distance and stalls: mean over the runs, of all robots of a run.\n\n"
            << table(metrics) << "sd: standard deviation. The interval is that of the median.\n";
  if (!has_later) return;
  std::cout << wrappedLine(
                   "\"later\": the event has not happened within the runs. The quantiles of a time that some "
                   "runs have not are those of the survival curve, in which it is later than these runs; "
                   "a mean is not known.",
                   kHelpColumns)
            << '\n';
}

/// One line per run.
std::string toCsv(const SweepPlan& plan, const SearchRuns& runs) {
  std::ostringstream csv;
  csv << "world,controller,seed,sim_time_s,ended_by,end_reason,driven_m,stalls,messages,digest";
  bool has_header = false;
  for (const auto& run : runs) {
    if (!run) continue;
    if (!has_header) {
      for (const auto& metric : run->metrics) csv << ',' << metric.name;
      csv << '\n';
      has_header = true;
    }
    const SweepPlan::Case c = plan.caseAt(run->case_index);
    csv << csvField(plan.worlds[c.world]) << ',' << csvField(plan.controllers[c.controller]) << ',' << run->seed << ','
        << fixed(run->sim_time_s, 3) << ',' << run->ended_by << ',' << csvField(run->end_reason) << ','
        << fixed(run->driven_m, 3) << ',' << run->stalls << ',' << run->messages_delivered << ',' << run->digest;
    for (const auto& metric : run->metrics) csv << ',' << (std::isfinite(metric.value) ? toText(metric.value) : "");
    csv << '\n';
  }
  return has_header ? csv.str() : csv.str() + "\n";
}

void bench(const BenchArguments& arguments) {
  RankGroup& group = rankGroup();
  refuseThreadsOnRanks(arguments.threads);
  const Sweep sweep(arguments.plan, arguments.worlds, arguments.changes);
  if (!group.isFirst()) return helpFirstRank(sweep);
  const SweepPlan& plan = sweep.plan();
  warnOfPartialStep(plan.time_s, plan.period_s);
  const Interrupt interrupt;
  std::optional<AtomicFile> csv;
  SearchRuns runs;
  requireSamePlan(group, sweep.planText());
  agree(group, [&] {
    refuseOverwriting(sweep.inputFiles(), {arguments.csv});
    for (const auto& file : arguments.worlds) refuseSameFile({{"WORLD", file}, {"--csv", arguments.csv}});
    // Opened before the runs, so that an invalid path is reported at once.
    if (!arguments.csv.empty()) csv.emplace(arguments.csv);
    runs.resize(sweep.runCount());
  });
  makeBenchRuns(
      sweep, arguments.threads, [&] { return interrupt.isRequested(); }, [](const SearchRun&) {}, runs);
  printTables(plan, runs);
  if (csv) {
    csv->write(toCsv(plan, runs));
    csv->commit();
  }
  printBenchSpeed(plan.worlds, runs);
  if (const std::size_t left = missing(runs).size(); left > 0) {
    setFailureShared();  // the other ranks have ended
    throw Interrupted("interrupted; the figures are of the " + std::to_string(runs.size() - left) + " of " +
                      std::to_string(runs.size()) + " runs that were completed");
  }
}

void addBenchMetrics(CLI::App& parent) {
  auto* command = parent.add_subcommand("metrics", "Tabulate the metrics of observers, over many seeded runs");
  auto a = std::make_shared<BenchArguments>();
  command->add_option("WORLD", a->worlds, "world files")
      ->type_name("FILE")
      ->transform(inputFile(kWorldKinds))
      ->required();
  addRunsAndSeed(*command, a->runs, a->plan.seed);
  addThreads(*command, a->threads, "concurrent runs; the table does not depend on it");
  addTime(*command, a->plan.time_s, "simulated time limit of a run");
  addStep(*command, a->plan.period_s);
  addRobotOptions(*command, a->changes);
  addStartDistanceOption(*command, a->changes);
  addNoiseOption(*command, a->changes);
  addControllersOption(*command, a->controllers);
  addObserverOption(*command, a->plan.observers, "add the metrics of this observer")->required();
  command->add_option("--csv", a->csv, "also write one line per run to this file")
      ->type_name("FILE")
      ->check(fileName());
  setGroup(*command, kRunGroup, {"--runs", "--controller", "--observer"});
  setGroup(*command, kWorldGroup, {"--seed"});
  setGroup(*command, kRecordingGroup, {"--csv"});
  command->callback([a] {
    a->plan.controllers = allControllers(a->controllers);
    a->plan.runs = static_cast<std::size_t>(a->runs);
    bench(*a);
  });
}

}  // namespace

void addBench(CLI::App& program) {
  auto* parent = addSubcommand(program, "bench");
  parent->require_subcommand(1);
  addBenchGold(*parent);
  addBenchMetrics(*parent);
}

}  // namespace robosim
