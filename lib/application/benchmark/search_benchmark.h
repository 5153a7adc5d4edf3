#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "benchmark/search_plan.h"
#include "benchmark/search_run.h"
#include "environment/start_poses.h"
#include "environment/world_changes.h"
#include "robots/fleet.h"
#include "robots/world_source.h"

namespace robosim {

/// A plan with its worlds, ready to run.
class SearchBenchmark : public NumberedRuns {
 public:
  /// Reads the worlds and checks all that can be checked before a run.
  /// @param files world files, by name or path; with their names and versions they are the plan's worlds
  /// @param changes to each world, before teams and conditions
  /// @throws ConfigError with all errors found, such as a world without gold
  SearchBenchmark(SearchPlan plan, const std::vector<std::string>& files, const WorldChanges& changes);

  const SearchPlan& plan() const { return plan_; }
  /// Files that the worlds were read from.
  const std::vector<std::filesystem::path>& inputFiles() const { return input_files_; }

  std::size_t runCount() const override { return plan_.runCount(); }
  /// @param index `runs` successive ones belong to one case
  std::optional<SearchRun> run(std::size_t index, const std::function<bool()>& is_interrupted) const override;
  std::string planText() const override;
  /// Repeats a run, and writes the page that shows it.
  /// @param file whose stem is its title
  /// @return false when interrupted; nothing is written then
  /// @throws ConfigError, ControllerError, ObserverError, RecordingError
  bool writePage(std::size_t index, const std::filesystem::path& file,
                 const std::function<bool()>& is_interrupted) const;

 private:
  struct PreparedWorld {
    WorldSource source;
    LoadedWorld world;
    RandomStarts starts;
  };
  const PreparedWorld& worldOf(const SearchPlan::Case& c) const {
    return *worlds_[(c.world * plan_.conditions.size() + c.condition) * plan_.teams.size() + c.team];
  }

  std::optional<SearchRun> run(std::size_t index, const std::function<bool()>& is_interrupted,
                               const std::function<void(const Environment&)>& observe) const;

  SearchPlan plan_;
  std::vector<std::filesystem::path> input_files_;
  std::vector<std::unique_ptr<PreparedWorld>> worlds_;  ///< by world, condition, team
};

}  // namespace robosim
