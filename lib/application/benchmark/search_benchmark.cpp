#include "benchmark/search_benchmark.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "replay/run_tables.h"
#include "run/local_run.h"
#include "run/output_files.h"
#include "run/outputs/run_note.h"
#include "run/seeded_run.h"

namespace robosim {
namespace {

bool hasGold(const World& world) {
  return std::any_of(world.objects.begin(), world.objects.end(),
                     [](const WorldObject& object) { return object.body.heat_celsius > 0; });
}

/// A world with a team under a condition.
WorldSource sourceFor(const WorldSource& source, const SearchPlan& plan, int team, const Condition& condition) {
  WorldChanges changes;
  if (team > 0) changes.team = team;
  if (condition.message_loss > 0) changes.message_loss = condition.message_loss;
  changes.noise = condition.noise;
  return withChanges(source, changes, plan.seed);
}

/// The world of a source, for all strategies. @throws ConfigError
LoadedWorld loadFor(const WorldSource& source, const SearchPlan& plan) {
  LoadedWorld loaded = loadWorldToRun(source, plan.strategies.front());
  ErrorList errors;
  for (const auto& strategy : plan.strategies) checkControllers(loaded, source.file, strategy, errors);
  errors.throwIfAny();
  return loaded;
}

}  // namespace

SearchBenchmark::SearchBenchmark(SearchPlan plan, const std::vector<std::string>& files, const WorldChanges& changes)
    : plan_(std::move(plan)) {
  for (const auto& file : files) {
    WorldSource source = readWorldSource(file);
    source.seed = plan_.seed;
    source = withChanges(source, changes, plan_.seed);
    const std::string name = std::filesystem::path(source.file).stem().string();
    if (std::count(plan_.worlds.begin(), plan_.worlds.end(), name) > 0) {
      throw ConfigError(file + ": there are two worlds named '" + name + "'; rename one of the files");
    }
    plan_.worlds.push_back(name);
    plan_.world_versions.push_back(versionOf(source));
    for (const auto& condition : plan_.conditions) {
      for (const int team : plan_.teams) {
        WorldSource changed = sourceFor(source, plan_, team, condition);
        LoadedWorld loaded = loadFor(changed, plan_);
        if (!hasGold(loaded.world)) {
          throw ConfigError(file + ": has no gold; give an object a <hot> above 0, or use robosim bench metrics");
        }
        RandomStarts starts(loaded.world, loaded.fleet);
        // Whether there is enough space is known only by drawing.
        starts.draw(plan_.seed);
        if (worlds_.empty() || worlds_.back()->world.world.name != name) {
          for (const auto& input : listInputFiles(file, loaded.world)) input_files_.push_back(input);
        }
        worlds_.push_back(
            std::make_unique<PreparedWorld>(PreparedWorld{std::move(changed), std::move(loaded), std::move(starts)}));
      }
    }
  }
}

std::string SearchBenchmark::planText() const { return plan_.json().dump(); }

std::optional<SearchRun> SearchBenchmark::run(std::size_t index, const std::function<bool()>& is_interrupted) const {
  return run(index, is_interrupted, {});
}

bool SearchBenchmark::writePage(std::size_t index, const std::filesystem::path& file,
                                const std::function<bool()>& is_interrupted) const {
  const SearchPlan::Case c = plan_.caseAt(index / plan_.runs);
  RunNote note;
  note.world = worldOf(c).source;
  note.world.seed = plan_.seed;  // of what it scatters
  note.seed = plan_.seed + index % plan_.runs;
  note.period_s = plan_.period_s;
  std::optional<RunTables> page;
  const auto observe = [&](const Environment& environment) {
    if (!page) {
      for (const auto& robot : environment.fleet().robots) {
        note.controllers.push_back(plan_.strategies[c.strategy].empty() ? *robot.controller
                                                                        : plan_.strategies[c.strategy]);
      }
      page.emplace(std::vector<RecordingOutput>{{file, RecordingFormat::page}}, note.world.file, environment, note);
    }
    page->observe(environment);
  };
  if (!run(index, is_interrupted, observe)) return false;
  page->finish();
  return true;
}

std::optional<SearchRun> SearchBenchmark::run(std::size_t index, const std::function<bool()>& is_interrupted,
                                              const std::function<void(const Environment&)>& observe) const {
  const std::size_t case_index = index / plan_.runs;
  const SearchPlan::Case c = plan_.caseAt(case_index);
  SeededRun how{.controller = plan_.strategies[c.strategy],
                .observers = {"effort"},
                .seed = plan_.seed + index % plan_.runs,
                .time_s = plan_.time_s,
                .period_s = plan_.period_s,
                .breakdown_mean_s = plan_.conditions[c.condition].breakdown_mean_s};
  how.observers.insert(how.observers.end(), plan_.observers.begin(), plan_.observers.end());
  const PreparedWorld& prepared = worldOf(c);
  const auto summary = runSeeded(prepared.world, prepared.starts, how, is_interrupted, observe);
  if (!summary) return std::nullopt;
  return SearchRun::of(case_index, *summary);
}

}  // namespace robosim
