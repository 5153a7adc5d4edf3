#include "benchmark/sweep.h"

#include <sstream>

#include <nlohmann/json.hpp>

#include "base/type_choice.h"
#include "robots/world_source.h"
#include "run/local_run.h"
#include "run/output_files.h"
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

Sweep::Sweep(SweepPlan plan, const std::vector<std::string>& files, const WorldChanges& changes)
    : plan_(std::move(plan)) {
  for (const auto& file : files) {
    WorldSource source = readWorldSource(file);
    source.seed = plan_.seed;
    source = withChanges(source, changes, plan_.seed);
    LoadedWorld loaded = loadWorldToRun(source, plan_.controllers.front());
    ErrorList errors;
    for (const auto& controller : plan_.controllers) checkControllers(loaded, file, controller, errors);
    errors.throwIfAny();
    plan_.worlds.push_back(loaded.world.name);
    plan_.world_versions.push_back(versionOf(source));
    for (const auto& input : listInputFiles(file, loaded.world)) input_files_.push_back(input);
    starts_.emplace_back(loaded.world, loaded.fleet);
    worlds_.push_back(std::move(loaded));
  }
}

std::optional<SearchRun> Sweep::run(std::size_t index, const std::function<bool()>& is_interrupted) const {
  const std::size_t case_index = index / plan_.runs;
  const SweepPlan::Case c = plan_.caseAt(case_index);
  const auto summary = runSeeded(worlds_[c.world], starts_[c.world],
                                 {.controller = plan_.controllers[c.controller],
                                  .observers = plan_.observers,
                                  .seed = plan_.seed + index % plan_.runs,
                                  .time_s = plan_.time_s,
                                  .period_s = plan_.period_s},
                                 is_interrupted);
  if (!summary) return std::nullopt;
  return SearchRun::of(case_index, *summary);
}

std::string Sweep::planText() const {
  return nlohmann::ordered_json{{"worlds", plan_.worlds},           {"world_versions", plan_.world_versions},
                                {"controllers", plan_.controllers}, {"observers", plan_.observers},
                                {"first_seed", plan_.seed},         {"runs", plan_.runs},
                                {"time_limit_s", plan_.time_s},     {"step_s", plan_.period_s}}
      .dump();
}

}  // namespace robosim
