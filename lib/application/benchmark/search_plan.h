#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "benchmark/condition.h"

namespace robosim {

/// A benchmark of searches: each strategy with each team in each world under each condition, with several seeds.
struct SearchPlan {
  std::vector<std::string> worlds;          ///< names, all different
  std::vector<std::string> world_versions;  ///< versionOf() of each, before teams and conditions
  std::vector<std::string> strategies{""};  ///< controllers of all robots, as TypeChoice::text(); "": the world's
  std::vector<int> teams{0};                ///< numbers of robots (WorldChanges::team); 0: the world's own robots
  std::vector<Condition> conditions{Condition{}};
  std::vector<std::string> observers;  ///< besides `effort`
  std::uint64_t seed = 1;              ///< of the first run, incremented by 1 for each further run
  std::size_t runs = 20;               ///< of each case, with different start poses
  double time_s = 1800;                ///< simulated time limit of a run, at which its search is censored
  double period_s = 0.1;               ///< time step

  /// Cases are ordered by world, condition, team, strategy, so that those to be compared are neighbours.
  struct Case {
    std::size_t world = 0, condition = 0, team = 0, strategy = 0;  ///< indices
    bool operator==(const Case&) const = default;
  };
  std::size_t caseCount() const { return worlds.size() * conditions.size() * teams.size() * strategies.size(); }
  Case caseAt(std::size_t index) const;
  std::size_t indexOf(const Case&) const;
  std::size_t runCount() const { return caseCount() * runs; }
  /// "maze_12, 4 robots, noise, levy_walk": what distinguishes a case within this plan.
  std::string caseName(const Case&) const;
  std::string teamName(std::size_t team) const;          ///< "4 robots", or "robots of the world"
  std::string strategyName(std::size_t strategy) const;  ///< or "of the world"

  /// All that the results depend on.
  nlohmann::ordered_json json() const;
};

}  // namespace robosim
