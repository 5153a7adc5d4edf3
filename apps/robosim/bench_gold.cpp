#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <sstream>

#include <CLI/CLI.hpp>

#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "environment/start_poses.h"
#include "robosim/arguments.h"
#include "robosim/subcommands.h"
#include "run/local_run.h"
#include "run/output_files.h"
#include "run/run_summary.h"

namespace robosim {
namespace {

struct BenchGoldArguments {
  std::vector<std::string> worlds;
  WorldChanges changes;
  int runs = 20;
  std::uint64_t seed = 1;
  int threads = 1;
  double time_s = 1800;
  double period_s = 0.1;
  std::string controller;
  std::string csv;

  bool timeIsUp(const SimTime& now) const { return now.seconds() + now.period_s / 2 > time_s; }
};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// @throws ConfigError also for a world without gold
LoadedWorld worldWithGold(const std::string& file, const BenchGoldArguments& arguments) {
  LoadedWorld loaded =
      arguments.changes.isNone()
          ? loadWorldToRun(file, arguments.controller, arguments.seed)
          : loadWorldToRun(withChanges(readWorldSource(file), arguments.changes, arguments.seed), arguments.controller);
  const auto is_gold = [](const WorldObject& object) { return object.body.heat_celsius > 0; };
  if (std::any_of(loaded.world.objects.begin(), loaded.world.objects.end(), is_gold)) return loaded;
  throw ConfigError(file + ": has no gold; give an object a <hot> above 0");
}

/// One run of the benchmark; its seed determines the start poses and all other random values.
/// @returns nullopt when interrupted
std::optional<RunSummary> runOnce(const LoadedWorld& world, const BenchGoldArguments& arguments, std::uint64_t seed,
                                  const Interrupt& interrupt) {
  const auto start = std::chrono::steady_clock::now();
  LoadedWorld shuffled = world;
  shuffleStartPoses(shuffled.world, shuffled.fleet, seed);
  // Runs are distributed over the threads and are independent of each other.
  RunOptions options;
  options.environment = {.seed = seed, .period_s = arguments.period_s, .threads = 1};
  options.controller = arguments.controller;
  LocalRun run(std::move(shuffled), options);
  while (!run.gold().all_halted_s && !arguments.timeIsUp(run.environment().time())) {
    if (interrupt.isRequested()) return std::nullopt;
    run.step();
  }
  RunSummary summary = RunSummary::of(run);
  summary.world = world.world.name;
  summary.seed = seed;
  summary.wall_s = secondsSince(start);
  return summary;
}

/// The `share` quantile of the values (nearest rank).
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

std::string secondsOrNever(double seconds) { return std::isfinite(seconds) ? fixed(seconds, 1) : "never"; }

std::vector<std::string> row(const std::string& world, std::span<const RunSummary> runs) {
  std::vector<double> times;
  double driven_m = 0;
  std::uint64_t stalls = 0;
  std::size_t found = 0;
  for (const auto& run : runs) {
    found += run.gold.found_s ? 1 : 0;
    times.push_back(run.gold.found_s.value_or(std::numeric_limits<double>::infinity()));
    driven_m += run.driven_m;
    stalls += run.stalls;
  }
  const auto n = static_cast<double>(runs.size());
  return {world,
          std::to_string(runs.size()),
          std::to_string(found),
          fixed(100 * static_cast<double>(found) / n, 1) + " %",
          secondsOrNever(quantile(times, 0.5)),
          secondsOrNever(quantile(times, 0.9)),
          fixed(driven_m / n, 1),
          fixed(static_cast<double>(stalls) / n, 1)};
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

/// One line per run.
std::string csvOf(const std::vector<RunSummary>& runs) {
  const auto or_empty = [](const std::optional<double>& s) { return s ? fixed(*s, 3) : ""; };
  std::ostringstream csv;
  csv << "world,seed,gold_found,gold_found_by,gold_time_s,all_halted_time_s,sim_time_s,driven_m,stalls,messages,"
         "digest\n";
  for (const auto& run : runs) {
    csv << quoted(run.world) << ',' << run.seed << ',' << (run.gold.found_s ? 1 : 0) << ','
        << quoted(run.gold.found_by.value_or("")) << ',' << or_empty(run.gold.found_s) << ','
        << or_empty(run.gold.all_halted_s) << ',' << fixed(run.sim_time_s, 3) << ',' << fixed(run.driven_m, 3) << ','
        << run.stalls << ',' << run.messages << ',' << run.digest << '\n';
  }
  return csv.str();
}

/// The completed runs of one world, in order of their seeds.
std::vector<RunSummary> completedRuns(std::span<const std::optional<RunSummary>> runs) {
  std::vector<RunSummary> completed;
  for (const auto& run : runs) {
    if (run) completed.push_back(*run);
  }
  return completed;
}

void benchGold(const BenchGoldArguments& arguments) {
  std::vector<LoadedWorld> worlds;
  for (const auto& file : arguments.worlds) {
    worlds.push_back(worldWithGold(file, arguments));
    refuseOverwriting(inputFilesOf(file, worlds.back().world), {arguments.csv});
  }
  for (const auto& file : arguments.worlds) refuseSameFile({{"WORLD", file}, {"--csv", arguments.csv}});
  warnOfPartialStep(arguments.time_s, arguments.period_s);
  const Interrupt interrupt;
  // Opened before the runs, so that an invalid path is reported at once.
  std::optional<AtomicFile> csv;
  if (!arguments.csv.empty()) csv.emplace(arguments.csv);

  const auto runs_per_world = static_cast<std::size_t>(arguments.runs);
  std::vector<std::optional<RunSummary>> runs(worlds.size() * runs_per_world);
  {
    Progress progress;
    std::mutex progress_mutex;
    std::size_t done = 0;
    ParallelExecutor(arguments.threads).forEach(runs.size(), 1, [&](std::size_t i) {
      if (interrupt.isRequested()) return;
      runs[i] = runOnce(worlds[i / runs_per_world], arguments, arguments.seed + i % runs_per_world, interrupt);
      const std::lock_guard lock(progress_mutex);
      ++done;
      if (progress.due()) progress.show("run " + std::to_string(done) + " of " + std::to_string(runs.size()));
    });
  }
  std::vector<std::vector<RunSummary>> completed;
  std::vector<RunSummary> all;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    completed.push_back(completedRuns(std::span(runs).subspan(w * runs_per_world, runs_per_world)));
    all.insert(all.end(), completed[w].begin(), completed[w].end());
  }
  Rows rows{{"world", "runs", "found", "success", "median [s]", "90 % [s]", "driven [m]", "stalls"}};
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    if (!completed[w].empty()) rows.push_back(row(worlds[w].world.name, completed[w]));
  }
  std::cout << table(rows)
            << "Times to the gold are simulated; a run without gold counts as infinite. Distance and stalls: all "
               "robots of a run.\n";
  if (csv) {
    csv->write(csvOf(all));
    csv->commit();
  }
  // Timings vary between repetitions, and are printed separately from the reproducible table.
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    if (completed[w].empty()) continue;
    double simulated_s = 0;
    double busy_s = 0;
    for (const auto& run : completed[w]) {
      simulated_s += run.sim_time_s;
      busy_s += run.wall_s;
    }
    std::cerr << printableText(worlds[w].world.name) << ": "
              << withCommas(static_cast<std::uint64_t>(simulated_s / busy_s))
              << " simulated seconds per second on one thread\n";
  }
  if (all.size() < runs.size()) {
    throw Interrupted("interrupted; the figures are of the " + std::to_string(all.size()) + " of " +
                      std::to_string(runs.size()) + " runs that were completed");
  }
}

}  // namespace

void addBench(CLI::App& program) {
  auto* bench = addSubcommand(program, "bench");
  bench->require_subcommand(1);
  auto* command = bench->add_subcommand("gold", "Measure success rate and time of finding gold, over many seeded runs");
  auto a = std::make_shared<BenchGoldArguments>();
  command->add_option("WORLD", a->worlds, "world files")->type_name("FILE")->required();
  command->add_option("--runs", a->runs, "runs of each world, with different start poses; 1 to 1000000")
      ->check(wholeNumberIn(1, 1000000))
      ->type_name("NUMBER")
      ->capture_default_str();
  command->add_option("--seed", a->seed, "seed of the first run, incremented by 1 for each further run; 0 to 2^64 - 1")
      ->check(seedNumber())
      ->type_name("NUMBER")
      ->capture_default_str();
  addThreads(*command, a->threads, "concurrent runs; the table does not depend on it");
  addTime(*command, a->time_s, "simulated time limit of a run");
  addStep(*command, a->period_s);
  addRobotOptions(*command, a->changes);
  addControllerOption(*command, a->controller, "controller of all robots, instead of those in the world");
  command->add_option("--csv", a->csv, "also write one line per run to this file")
      ->type_name("FILE")
      ->check(fileName());
  command->callback([a] { benchGold(*a); });
}

}  // namespace robosim
