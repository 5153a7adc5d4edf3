// robosim bench metrics: tables of observers' metrics over worlds, controllers, parameters and seeds.
#include <chrono>
#include <cmath>
#include <iostream>
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
#include "ranks/rank_group.h"
#include "replay/csv_field.h"
#include "robosim/arguments.h"
#include "robosim/bench_arguments.h"
#include "robosim/command_line.h"
#include "robosim/subcommands.h"
#include "run/output_files.h"
#include "run/sweep.h"

namespace robosim {
namespace {

struct BenchArguments {
  std::vector<std::string> worlds;
  WorldChanges changes;
  SweepOptions sweep;
  int runs = 20;
  std::vector<std::string> controllers;  ///< may have lists of values
  std::string csv;
};

/// A world for all controllers. @throws ConfigError
LoadedWorld worldFor(const std::string& file, const BenchArguments& arguments) {
  WorldSource source = readWorldSource(file);
  source.seed = arguments.sweep.seed;
  source = withChanges(source, arguments.changes, arguments.sweep.seed);
  const auto& controllers = arguments.sweep.controllers;
  LoadedWorld loaded = loadWorldToRun(source, controllers.front());
  ErrorList errors;
  for (const auto& controller : controllers) checkControllers(loaded, file, controller, errors);
  errors.throwIfAny();
  return loaded;
}

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

std::vector<std::string> header(bool has_controllers, const std::vector<Metric>& metrics) {
  std::vector<std::string> cells{"world"};
  if (has_controllers) cells.emplace_back("controller");
  cells.insert(cells.end(), {"runs", "driven [m]", "stalls"});
  for (const auto& metric : metrics) cells.push_back(metric.name);
  return cells;
}

std::vector<std::string> row(const SweepGroup& group, bool has_controllers) {
  double driven_m = 0;
  std::uint64_t stalls = 0;
  for (const auto& run : group.runs) {
    driven_m += run.driven_m;
    stalls += run.stalls;
  }
  const auto n = static_cast<double>(group.runs.size());
  std::vector<std::string> cells{group.world};
  if (has_controllers) cells.push_back(group.controller.empty() ? "of the world" : group.controller);
  cells.push_back(std::to_string(group.runs.size()));
  cells.push_back(fixed(driven_m / n, 1));
  cells.push_back(fixed(static_cast<double>(stalls) / n, 1));
  for (std::size_t i = 0; i < group.runs.front().metrics.size(); ++i) cells.push_back(metricText(group.runs, i));
  return cells;
}

/// One line per run.
std::string csvOf(const std::vector<SweepGroup>& groups, const std::vector<Metric>& metrics) {
  std::ostringstream csv;
  csv << "world,controller,seed,sim_time_s,driven_m,stalls,messages,digest";
  for (const auto& metric : metrics) csv << ',' << metric.name;
  csv << '\n';
  for (const auto& group : groups) {
    for (const auto& run : group.runs) {
      csv << csvField(group.world) << ',' << csvField(group.controller) << ',' << run.seed << ','
          << fixed(run.sim_time_s, 3) << ',' << fixed(run.driven_m, 3) << ',' << run.stalls << ',' << run.messages
          << ',' << run.digest;
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
  if (rankGroup().size() > 1) {
    throw ConfigError("'robosim bench metrics' runs in one process, with --threads; start it without mpirun or srun");
  }
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
    const auto start = Progress::Clock::now();
    groups = sweep(
        worlds, arguments.sweep, [&] { return interrupt.isRequested(); },
        [&](std::size_t done) {
          completed = done;
          if (!progress.due()) return;
          const double elapsed_s = std::chrono::duration<double>(Progress::Clock::now() - start).count();
          progress.show("run " + std::to_string(done) + " of " + std::to_string(planned) +
                        commaRemainingTime(elapsed_s, static_cast<double>(done), static_cast<double>(planned)));
        });
  }
  std::vector<Metric> metrics;
  for (const auto& group : groups) {
    if (!group.runs.empty()) metrics = group.runs.front().metrics;
  }
  const bool has_controllers = arguments.sweep.controllers.size() > 1;
  Rows rows{header(has_controllers, metrics)};
  for (const auto& group : groups) {
    if (!group.runs.empty()) rows.push_back(row(group, has_controllers));
  }
  std::cout << table(rows) << "Distance and stalls: all robots of a run. Metrics: mean ± standard deviation over the "
            << "runs.\n";
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

void addBenchMetrics(CLI::App& parent) {
  auto* command = parent.add_subcommand("metrics", "Tabulate the metrics of observers, over many seeded runs");
  auto a = std::make_shared<BenchArguments>();
  command->add_option("WORLD", a->worlds, "world files")
      ->type_name("FILE")
      ->transform(inputFile(kWorldKinds))
      ->required();
  addRunsAndSeed(*command, a->runs, a->sweep.seed);
  addThreads(*command, a->sweep.threads, "concurrent runs; the table does not depend on it");
  addTime(*command, a->sweep.time_s, "simulated time limit of a run");
  addStep(*command, a->sweep.period_s);
  addRobotOptions(*command, a->changes);
  addStartDistanceOption(*command, a->changes);
  addNoiseOption(*command, a->changes);
  addControllersOption(*command, a->controllers);
  addObserverOption(*command, a->sweep.observers, "add the metrics of this observer")->required();
  command->add_option("--csv", a->csv, "also write one line per run to this file")
      ->type_name("FILE")
      ->check(fileName());
  setGroup(*command, kRunGroup, {"--runs", "--controller", "--observer"});
  setGroup(*command, kWorldGroup, {"--seed"});
  setGroup(*command, kRecordingGroup, {"--csv"});
  command->callback([a] {
    a->sweep.controllers = allControllers(a->controllers);
    a->sweep.runs = static_cast<std::size_t>(a->runs);
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
