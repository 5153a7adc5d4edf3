// robosim bench gold and robosim bench metrics: tables over worlds, controllers, parameters and seeds.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <sstream>

#include <CLI/CLI.hpp>

#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "replay/csv_field.h"
#include "robosim/arguments.h"
#include "robosim/subcommands.h"
#include "run/output_files.h"
#include "run/sweep.h"

namespace robosim {
namespace {

struct BenchArguments {
  bool is_about_gold = true;  ///< bench gold; else bench metrics
  std::vector<std::string> worlds;
  WorldChanges changes;
  SweepOptions sweep;
  int runs = 20;
  std::vector<std::string> controllers;  ///< may have lists of values
  std::string csv;
};

/// A world for all controllers. @throws ConfigError also for a world without gold, when it is needed
LoadedWorld worldFor(const std::string& file, const BenchArguments& arguments) {
  WorldSource source = readWorldSource(file);
  source.seed = arguments.sweep.seed;
  source = withChanges(source, arguments.changes, arguments.sweep.seed);
  const auto& controllers = arguments.sweep.controllers;
  LoadedWorld loaded = loadWorldToRun(source, controllers.front());
  ErrorList errors;
  for (const auto& controller : controllers) checkControllers(loaded, file, controller, errors);
  errors.throwIfAny();
  const auto is_gold = [](const WorldObject& object) { return object.body.heat_celsius > 0; };
  if (arguments.is_about_gold && std::none_of(loaded.world.objects.begin(), loaded.world.objects.end(), is_gold)) {
    throw ConfigError(file + ": has no gold; give an object a <hot> above 0, or use robosim bench metrics");
  }
  return loaded;
}

/// The `share` quantile of the values (nearest rank).
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

std::string secondsOrNever(double seconds) { return std::isfinite(seconds) ? fixed(seconds, 1) : "never"; }

/// "12.5 ± 0.7": mean and standard deviation over the runs that have the metric, "(3)" with their number if not all.
std::string metricText(std::span<const RunSummary> runs, std::size_t metric) {
  double n = 0, mean = 0, squares = 0;
  for (const auto& run : runs) {
    const double value = run.metrics[metric].value;
    if (!std::isfinite(value)) continue;
    ++n;
    const double step = value - mean;
    mean += step / n;
    squares += step * (value - mean);
  }
  if (n == 0) return "none";
  const double deviation = n > 1 ? std::sqrt(squares / (n - 1)) : 0;
  const std::string all = n < static_cast<double>(runs.size()) ? " (" + fixed(n, 0) + ")" : "";
  return fixed(mean, 2) + (n > 1 ? " ± " + fixed(deviation, 2) : "") + all;
}

/// Columns that a table has only if they say something.
struct Columns {
  bool gold, controller;
};

std::vector<std::string> header(const Columns& columns, const std::vector<Metric>& metrics) {
  std::vector<std::string> cells{"world"};
  if (columns.controller) cells.emplace_back("controller");
  cells.emplace_back("runs");
  if (columns.gold) cells.insert(cells.end(), {"found", "success", "median [s]", "90 % [s]"});
  cells.insert(cells.end(), {"driven [m]", "stalls"});
  for (const auto& metric : metrics) cells.push_back(metric.name);
  return cells;
}

std::vector<std::string> row(const SweepGroup& group, const Columns& columns) {
  std::vector<double> times;
  double driven_m = 0;
  std::uint64_t stalls = 0;
  std::size_t found = 0;
  for (const auto& run : group.runs) {
    found += run.gold.found_s ? 1 : 0;
    times.push_back(run.gold.found_s.value_or(std::numeric_limits<double>::infinity()));
    driven_m += run.driven_m;
    stalls += run.stalls;
  }
  const auto n = static_cast<double>(group.runs.size());
  std::vector<std::string> cells{group.world};
  if (columns.controller) cells.push_back(group.controller.empty() ? "of the world" : group.controller);
  cells.push_back(std::to_string(group.runs.size()));
  if (columns.gold) {
    cells.insert(cells.end(), {std::to_string(found), fixed(100 * static_cast<double>(found) / n, 1) + " %",
                               secondsOrNever(quantile(times, 0.5)), secondsOrNever(quantile(times, 0.9))});
  }
  cells.push_back(fixed(driven_m / n, 1));
  cells.push_back(fixed(static_cast<double>(stalls) / n, 1));
  for (std::size_t i = 0; i < group.runs.front().metrics.size(); ++i) cells.push_back(metricText(group.runs, i));
  return cells;
}

/// One line per run.
std::string csvOf(const std::vector<SweepGroup>& groups, const std::vector<Metric>& metrics) {
  const auto or_empty = [](const std::optional<double>& s) { return s ? fixed(*s, 3) : ""; };
  std::ostringstream csv;
  csv << "world,controller,seed,gold_found,gold_found_by,gold_time_s,all_halted_time_s,sim_time_s,driven_m,stalls,"
         "messages,digest";
  for (const auto& metric : metrics) csv << ',' << metric.name;
  csv << '\n';
  for (const auto& group : groups) {
    for (const auto& run : group.runs) {
      csv << csvField(group.world) << ',' << csvField(group.controller) << ',' << run.seed << ','
          << (run.gold.found_s ? 1 : 0) << ',' << csvField(run.gold.found_by.value_or("")) << ','
          << or_empty(run.gold.found_s) << ',' << or_empty(run.gold.all_halted_s) << ',' << fixed(run.sim_time_s, 3)
          << ',' << fixed(run.driven_m, 3) << ',' << run.stalls << ',' << run.messages << ',' << run.digest;
      for (const auto& metric : run.metrics) csv << ',' << (std::isfinite(metric.value) ? toText(metric.value) : "");
      csv << '\n';
    }
  }
  return csv.str();
}

/// Timings vary between repetitions, and are printed separately from the reproducible table.
void printSpeed(const std::vector<SweepGroup>& groups) {
  for (std::size_t i = 0; i < groups.size();) {
    double simulated_s = 0;
    double busy_s = 0;
    const std::string& world = groups[i].world;
    for (; i < groups.size() && groups[i].world == world; ++i) {
      for (const auto& run : groups[i].runs) {
        simulated_s += run.sim_time_s;
        busy_s += run.wall_s;
      }
    }
    if (busy_s <= 0) continue;
    std::cerr << printableText(world) << ": " << withCommas(static_cast<std::uint64_t>(simulated_s / busy_s))
              << " simulated seconds per second on one thread\n";
  }
}

void bench(const BenchArguments& arguments) {
  std::vector<LoadedWorld> worlds;
  for (const auto& file : arguments.worlds) {
    worlds.push_back(worldFor(file, arguments));
    refuseOverwriting(inputFilesOf(file, worlds.back().world), {arguments.csv});
  }
  for (const auto& file : arguments.worlds) refuseSameFile({{"WORLD", file}, {"--csv", arguments.csv}});
  warnOfPartialStep(arguments.sweep.time_s, arguments.sweep.period_s);
  const Interrupt interrupt;
  // Opened before the runs, so that an invalid path is reported at once.
  std::optional<AtomicFile> csv;
  if (!arguments.csv.empty()) csv.emplace(arguments.csv);

  const std::size_t planned = worlds.size() * arguments.sweep.controllers.size() * arguments.sweep.runs;
  std::size_t completed = 0;
  std::vector<SweepGroup> groups;
  {
    Progress progress;
    groups = sweep(
        worlds, arguments.sweep, [&] { return interrupt.isRequested(); },
        [&](std::size_t done) {
          completed = done;
          if (progress.due()) progress.show("run " + std::to_string(done) + " of " + std::to_string(planned));
        });
  }
  std::vector<Metric> metrics;
  for (const auto& group : groups) {
    if (!group.runs.empty()) metrics = group.runs.front().metrics;
  }
  const Columns columns{arguments.is_about_gold, arguments.sweep.controllers.size() > 1};
  Rows rows{header(columns, metrics)};
  for (const auto& group : groups) {
    if (!group.runs.empty()) rows.push_back(row(group, columns));
  }
  std::cout << table(rows);
  if (columns.gold) std::cout << "Times to the gold are simulated; a run without gold counts as infinite. ";
  std::cout << "Distance and stalls: all robots of a run.";
  if (!metrics.empty()) std::cout << " Metrics: mean ± standard deviation over the runs.";
  std::cout << '\n';
  if (csv) {
    csv->write(csvOf(groups, metrics));
    csv->commit();
  }
  printSpeed(groups);
  if (completed < planned) {
    throw Interrupted("interrupted; the figures are of the " + std::to_string(completed) + " of " +
                      std::to_string(planned) + " runs that were completed");
  }
}

/// The choices of --controller with their lists of values expanded. @throws ConfigError
std::vector<std::string> allChoices(const std::vector<std::string>& given) {
  std::vector<std::string> all;
  for (const auto& text : given) {
    for (const auto& choice : expandedChoices(text)) {
      checkController(choice);
      all.push_back(choice);
    }
  }
  if (all.empty()) all.emplace_back();
  return all;
}

void addBenchCommand(CLI::App& parent, const std::string& name, const std::string& help, bool is_about_gold) {
  auto* command = parent.add_subcommand(name, help);
  auto a = std::make_shared<BenchArguments>();
  a->is_about_gold = is_about_gold;
  command->add_option("WORLD", a->worlds, "world files")->type_name("FILE")->transform(inputFile())->required();
  command
      ->add_option("--runs", a->runs, "runs of each controller in each world, with different start poses; 1 to 1000000")
      ->check(wholeNumberIn(1, 1000000))
      ->type_name("NUMBER")
      ->capture_default_str();
  command
      ->add_option("--seed", a->sweep.seed,
                   "seed of the first run, incremented by 1 for each further run; 0 to 2^64 - 1")
      ->check(seedNumber())
      ->type_name("NUMBER")
      ->capture_default_str();
  addThreads(*command, a->sweep.threads, "concurrent runs; the table does not depend on it");
  addTime(*command, a->sweep.time_s, "simulated time limit of a run");
  addStep(*command, a->sweep.period_s);
  addRobotOptions(*command, a->changes);
  addNoiseOption(*command, a->changes);
  command
      ->add_option("--controller", a->controllers,
                   "controller of all robots, instead of those in the world, as NAME or \"NAME PARAMETER=VALUE …\"; "
                   "repeatable. \"NAME PARAMETER=1,2,3\" compares values")
      ->type_name("CONTROLLER")
      ->allow_extra_args(false);
  auto* observers = addObserverOption(*command, a->sweep.observers, "add the metrics of this observer");
  if (!is_about_gold) observers->required();
  command->add_option("--csv", a->csv, "also write one line per run to this file")
      ->type_name("FILE")
      ->check(fileName());
  command->callback([a] {
    a->sweep.controllers = allChoices(a->controllers);
    a->sweep.runs = static_cast<std::size_t>(a->runs);
    bench(*a);
  });
}

}  // namespace

void addBench(CLI::App& program) {
  auto* parent = addSubcommand(program, "bench");
  parent->require_subcommand(1);
  addBenchCommand(*parent, "gold", "Measure success rate and time of finding gold, over many seeded runs", true);
  addBenchCommand(*parent, "metrics", "Tabulate the metrics of observers, over many seeded runs", false);
}

}  // namespace robosim
