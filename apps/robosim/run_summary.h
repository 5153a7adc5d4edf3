#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "robosim/local_run.h"

namespace robosim {

/// Why a run came to its end.
enum class EndedBy { all_halted, time_limit, interrupt, control_panel };

/// What is told at the end of a run.
struct RunSummary {
  std::string world;
  std::uint64_t seed = 0;
  std::size_t robots = 0;
  std::uint64_t steps = 0;
  double sim_time_s = 0;
  double wall_s = 0;
  EndedBy ended_by = EndedBy::all_halted;
  std::string digest;
  GoldOutcome gold;
  double driven_m = 0;  ///< by all robots together
  std::uint64_t stalls = 0;
  std::uint64_t messages = 0;
  std::optional<std::uint64_t> late;  ///< robot-steps whose command came too late; nullopt for a run that waits

  /// Everything that the run itself can tell; the rest is the caller's.
  static RunSummary of(const LocalRun& run);
  double realTimeFactor() const { return wall_s > 0 ? sim_time_s / wall_s : 0; }
  nlohmann::ordered_json json() const;
  /// A few lines for a person.
  std::string text() const;
};

}  // namespace robosim
