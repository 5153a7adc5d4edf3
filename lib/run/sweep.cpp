#include "run/sweep.h"

#include <chrono>
#include <mutex>
#include <optional>
#include <sstream>

#include "base/parallel_executor.h"
#include "base/type_choice.h"
#include "environment/start_poses.h"

namespace robosim {
namespace {

constexpr std::size_t kChoicesMax = 10'000;

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text + ",");
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

/// @return nullopt when interrupted
std::optional<RunSummary> oneRun(const LoadedWorld& world, const RandomStarts& starts, const SweepOptions& options,
                                 const std::string& controller, std::uint64_t seed,
                                 const std::function<bool()>& is_interrupted) {
  const auto start = std::chrono::steady_clock::now();
  LoadedWorld shuffled = world;
  setStartPoses(shuffled.fleet, starts.draw(seed));
  RunOptions run_options;
  run_options.environment = {.seed = seed, .period_s = options.period_s, .threads = 1};
  run_options.controller = controller;
  run_options.observers = options.observers;
  run_options.observers_log = false;
  LocalRun run(std::move(shuffled), run_options);
  const auto is_time_up = [&] {
    const SimTime now = run.environment().time();
    return now.seconds() + now.period_s / 2 > options.time_s;
  };
  while (!run.isOver() && !is_time_up()) {
    if (is_interrupted()) return std::nullopt;
    run.step();
  }
  RunSummary summary = RunSummary::of(run);
  summary.world = world.world.name;
  summary.seed = seed;
  summary.ended_by = endedByItself(run);
  summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return summary;
}

}  // namespace

std::vector<std::string> expandedChoices(const std::string& choice) {
  const TypeChoice parsed = TypeChoice::parse(choice);
  std::vector<TypeChoice> all{{parsed.name, {}}};
  for (const auto& [name, values] : parsed.parameters) {
    std::vector<TypeChoice> longer;
    const auto parts = splitAtCommas(values);
    if (all.size() * parts.size() > kChoicesMax) {
      throw ConfigError("'" + choice + "' stands for more than 10,000 combinations of values; list fewer values");
    }
    for (const auto& one : all) {
      for (const auto& value : parts) {
        longer.push_back(one);
        longer.back().parameters.emplace_back(name, value);
      }
    }
    all = std::move(longer);
  }
  std::vector<std::string> texts;
  for (const auto& one : all) texts.push_back(one.text());
  return texts;
}

std::vector<SweepGroup> sweep(const std::vector<LoadedWorld>& worlds, const SweepOptions& options,
                              const std::function<bool()>& is_interrupted,
                              const std::function<void(std::size_t done)>& progress) {
  std::vector<SweepGroup> groups;
  std::vector<RandomStarts> starts;  // by world
  for (const auto& world : worlds) {
    starts.emplace_back(world.world, world.fleet);
    for (const auto& controller : options.controllers) groups.push_back({world.world.name, controller, {}});
  }
  std::vector<std::optional<RunSummary>> runs(groups.size() * options.runs);
  std::mutex progress_mutex;
  std::size_t done = 0;
  ParallelExecutor(options.threads).forEach(runs.size(), 1, [&](std::size_t i) {
    if (is_interrupted()) return;
    const std::size_t group = i / options.runs;
    const std::size_t world = group / options.controllers.size();
    runs[i] = oneRun(worlds[world], starts[world], options, groups[group].controller, options.seed + i % options.runs,
                     is_interrupted);
    const std::lock_guard lock(progress_mutex);
    progress(++done);
  });
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i]) groups[i / options.runs].runs.push_back(std::move(*runs[i]));
  }
  return groups;
}

}  // namespace robosim
