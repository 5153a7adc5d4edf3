#include "run/sweep.h"

#include <mutex>
#include <optional>
#include <sstream>

#include "base/parallel_executor.h"
#include "base/type_choice.h"
#include "environment/start_poses.h"
#include "run/seeded_run.h"

namespace robosim {
namespace {

constexpr std::size_t kChoicesMax = 10'000;

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text + ",");
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
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
    runs[i] = runSeeded(worlds[world], starts[world],
                        {.controller = groups[group].controller,
                         .observers = options.observers,
                         .seed = options.seed + i % options.runs,
                         .time_s = options.time_s,
                         .period_s = options.period_s},
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
