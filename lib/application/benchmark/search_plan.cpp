#include "benchmark/search_plan.h"

#include <nlohmann/json.hpp>

namespace robosim {

SearchPlan::Case SearchPlan::caseAt(std::size_t index) const {
  Case result;
  result.strategy = index % strategies.size();
  index /= strategies.size();
  result.team = index % teams.size();
  index /= teams.size();
  result.condition = index % conditions.size();
  result.world = index / conditions.size();
  return result;
}

std::size_t SearchPlan::indexOf(const Case& c) const {
  return ((c.world * conditions.size() + c.condition) * teams.size() + c.team) * strategies.size() + c.strategy;
}

std::string SearchPlan::caseName(const Case& c) const {
  std::string name = worlds[c.world];
  if (teams.size() > 1 || teams.front() > 0) name += ", " + teamName(c.team);
  if (conditions.size() > 1 || conditions.front() != Condition{}) name += ", " + conditions[c.condition].text();
  return name + ", " + strategyName(c.strategy);
}

std::string SearchPlan::teamName(std::size_t team) const {
  const int size = teams[team];
  if (size == 0) return "robots of the world";
  return size == 1 ? "1 robot" : std::to_string(size) + " robots";
}

std::string SearchPlan::strategyName(std::size_t strategy) const {
  return strategies[strategy].empty() ? "of the world" : strategies[strategy];
}

nlohmann::ordered_json SearchPlan::json() const {
  std::vector<std::string> condition_texts;
  for (const auto& condition : conditions) condition_texts.push_back(condition.text());
  return {{"worlds", worlds},
          {"world_versions", world_versions},
          {"strategies", strategies},
          {"teams", teams},
          {"conditions", condition_texts},
          {"observers", observers},
          {"first_seed", seed},
          {"runs", runs},
          {"time_limit_s", time_s},
          {"step_s", period_s}};
}

}  // namespace robosim
