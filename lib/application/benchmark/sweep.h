#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/search_run.h"
#include "environment/start_poses.h"
#include "environment/world_changes.h"
#include "robots/fleet.h"

namespace robosim {

/// The choices that a text with lists of values stands for, in order: "flocking cohesion=0.1,0.3 radius_m=1,2" is four.
/// @throws ConfigError for a malformed text, and for more than 10,000 choices
std::vector<std::string> expandedChoices(const std::string& choice);

/// Many independent runs: each controller in each world, with several seeds.
struct SweepPlan {
  std::vector<std::string> worlds;           ///< names
  std::vector<std::string> world_versions;   ///< versionOf() of each
  std::vector<std::string> controllers{""};  ///< of all robots, as TypeChoice::text(); "": those of the world
  std::vector<std::string> observers;        ///< of each run; they do not log
  std::uint64_t seed = 1;                    ///< of the first run, incremented by 1 for each further run
  std::size_t runs = 20;                     ///< of each controller in each world, with different start poses
  double time_s = 1800;                      ///< simulated time limit of a run
  double period_s = 0.1;                     ///< time step

  struct Case {
    std::size_t world = 0, controller = 0;  ///< indices
  };
  std::size_t caseCount() const { return worlds.size() * controllers.size(); }
  Case caseAt(std::size_t index) const { return {index / controllers.size(), index % controllers.size()}; }
};

/// A plan with its worlds, ready to run. Each run begins at random start poses (RandomStarts).
class Sweep : public NumberedRuns {
 public:
  /// Reads the worlds and checks all that can be checked before a run.
  /// @param plan without worlds @param files world files, by path @param changes to each world
  /// @throws ConfigError with all errors found
  Sweep(SweepPlan plan, const std::vector<std::string>& files, const WorldChanges& changes);

  const SweepPlan& plan() const { return plan_; }
  /// Files that the worlds were read from.
  const std::vector<std::filesystem::path>& inputFiles() const { return input_files_; }
  std::size_t runCount() const override { return plan_.caseCount() * plan_.runs; }
  /// @param index `runs` successive ones belong to one case
  std::optional<SearchRun> run(std::size_t index, const std::function<bool()>& is_interrupted) const override;
  std::string planText() const override;

 private:
  SweepPlan plan_;
  std::vector<std::filesystem::path> input_files_;
  std::vector<LoadedWorld> worlds_;
  std::vector<RandomStarts> starts_;  ///< by world
};

}  // namespace robosim
