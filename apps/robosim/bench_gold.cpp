#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <mutex>

#include <CLI/CLI.hpp>

#include "environment/start_poses.h"
#include "maze/controllers.h"
#include "robosim/arguments.h"
#include "robosim/interrupt.h"
#include "robosim/local_run.h"
#include "robosim/progress.h"
#include "robosim/run_summary.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"

namespace robosim {
namespace {

struct Arguments {
  std::vector<std::string> worlds;
  int runs = 20;
  std::uint64_t seed = 1;
  int threads = 1;
  double time_s = 1800;
  double period_s = 0.1;
  std::string controller;
  std::string csv;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// One run of the bench; its seed gives the starts and all else that is left to chance.
RunSummary runOnce(const LoadedWorld& world, const Arguments& arguments, std::uint64_t seed,
                   const Interrupt& interrupt) {
  const auto start = std::chrono::steady_clock::now();
  LoadedWorld shuffled = world;
  shuffleStartPoses(shuffled.world, shuffled.fleet, seed);
  // Runs are spread over the threads, each on one: no two of them wait for each other.
  RunOptions options;
  options.environment = {.seed = seed, .period_s = arguments.period_s, .threads = 1};
  options.controller = arguments.controller;
  LocalRun run(std::move(shuffled), options);
  while (!run.gold().all_halted_s && run.environment().time().seconds() < arguments.time_s && !interrupt.asked()) {
    run.step();
  }
  RunSummary summary = RunSummary::of(run);
  summary.world = world.world.name;
  summary.seed = seed;
  summary.wall_s = secondsSince(start);
  return summary;
}

/// The value that `share` of all values do not exceed (nearest rank).
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

void writeCsv(std::ofstream& csv, const std::string& file, const std::vector<RunSummary>& runs) {
  const auto or_empty = [](const std::optional<double>& s) { return s ? fixed(*s, 3) : ""; };
  csv << "world,seed,gold_found,gold_found_by,gold_time_s,all_halted_time_s,sim_time_s,driven_m,stalls,messages,"
         "digest\n";
  for (const auto& run : runs) {
    csv << quoted(run.world) << ',' << run.seed << ',' << (run.gold.found_s ? 1 : 0) << ','
        << quoted(run.gold.found_by.value_or("")) << ',' << or_empty(run.gold.found_s) << ','
        << or_empty(run.gold.all_halted_s) << ',' << fixed(run.sim_time_s, 3) << ',' << fixed(run.driven_m, 3) << ','
        << run.stalls << ',' << run.messages << ',' << run.digest << '\n';
  }
  csv.flush();
  if (!csv) throw std::runtime_error(file + ": writing failed; is the disk full?");
}

void benchGold(const Arguments& arguments) {
  std::vector<LoadedWorld> worlds;
  for (const auto& file : arguments.worlds) worlds.push_back(loadWorldToRun(file, arguments.controller));
  for (const auto& file : arguments.worlds) refuseSameFile({{"WORLD", file}, {"--csv", arguments.csv}});
  const Interrupt interrupt;
  // Opened before the work, so that an unwritable path costs nobody the wait; an older file of that name stays until
  // the end.
  const std::string unfinished = arguments.csv + ".part";
  std::ofstream csv;
  if (!arguments.csv.empty()) {
    csv.open(unfinished);
    if (!csv) throw ConfigError(arguments.csv + ": cannot be written; check the folder and its permissions");
  }

  const auto runs_per_world = static_cast<std::size_t>(arguments.runs);
  std::vector<RunSummary> runs(worlds.size() * runs_per_world);
  {
    Progress progress;
    std::mutex progress_mutex;
    std::size_t done = 0;
    Workers(arguments.threads).forEach(runs.size(), 1, [&](std::size_t i) {
      if (interrupt.asked()) return;
      runs[i] = runOnce(worlds[i / runs_per_world], arguments, arguments.seed + i % runs_per_world, interrupt);
      const std::lock_guard lock(progress_mutex);
      ++done;
      if (progress.due()) progress.show("run " + std::to_string(done) + " of " + std::to_string(runs.size()));
    });
  }
  if (interrupt.asked()) {
    if (csv.is_open()) std::filesystem::remove(unfinished);
    throw std::runtime_error("interrupted before all runs were done; their figures would mislead, so there are none");
  }

  Rows rows{{"world", "runs", "found", "success", "median [s]", "90 % [s]", "driven [m]", "stalls"}};
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    rows.push_back(row(worlds[w].world.name, std::span(runs).subspan(w * runs_per_world, runs_per_world)));
  }
  std::cout
      << table(rows)
      << "Times to the gold are simulated; a run without gold counts as never. Way and stalls: all robots of a run.\n";
  if (csv.is_open()) {
    writeCsv(csv, arguments.csv, runs);
    csv.close();
    std::filesystem::rename(unfinished, arguments.csv);
  }
  // The figures that differ from time to time go where the table's readers are not disturbed by them.
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    double simulated_s = 0;
    double busy_s = 0;
    for (const auto& run : std::span(runs).subspan(w * runs_per_world, runs_per_world)) {
      simulated_s += run.sim_time_s;
      busy_s += run.wall_s;
    }
    std::cerr << worlds[w].world.name << ": " << withCommas(static_cast<std::uint64_t>(simulated_s / busy_s))
              << " simulated seconds per second on one thread\n";
  }
}

}  // namespace

void addBenchGold(CLI::App& bench) {
  auto* command = bench.add_subcommand("gold", "How surely and how soon robots find the gold, over many seeded runs");
  auto a = std::make_shared<Arguments>();
  command->add_option("WORLD", a->worlds, "world files")->type_name("FILE")->required();
  command->add_option("--runs", a->runs, "runs a world, each with the robots at other starts")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", a->seed, "of the first run; the next ones count up")
      ->check(seedNumber())
      ->capture_default_str();
  command->add_option("--threads", a->threads, "runs at a time; the table is the same for any number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--time", a->time_s, "simulated seconds after which a run is given up")
      ->check(numberIn(1e-3, 1e9))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_option("--step", a->period_s, "length of a time step, seconds")
      ->check(numberIn(0.001, 1))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_option("--controller", a->controller, "for all robots, in place of what the world names")
      ->check(CLI::IsMember(controllerNames()));
  command->add_option("--csv", a->csv, "also write a line per run to this file")->type_name("FILE")->check(fileName());
  command->callback([a] { benchGold(*a); });
}

}  // namespace robosim
