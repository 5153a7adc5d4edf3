#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/text_table.h"
#include "environment/run_report.h"
#include "run/local_run.h"

namespace robosim {

/// Reason why a run ended, or with `recording_stopped` its recording before it.
enum class EndedBy {
  all_halted,
  time_limit,
  interrupt,
  control_panel,
  arcos_program,  ///< by loading another map
  robot_lost,
  window_closed,
  observer,
  intervention,
  recording_stopped
};

/// As in JSON: "all_halted", "time_limit"
const char* nameOf(EndedBy why);

/// Why a run ended that neither a person nor a lost robot has ended: an intervention, all robots halted, an observer,
/// or the time limit.
EndedBy endedByItself(const LocalRun& run);

/// By name; null for a metric without a value.
nlohmann::ordered_json metricsJson(const std::vector<Metric>& metrics);
/// Lines of a listing().
Rows metricRows(const std::vector<Metric>& metrics);

/// Result of a run, printed at its end.
struct RunSummary {
  std::string world;
  std::uint64_t seed = 0;
  bool depends_on_seed = true;  ///< whether another seed would give another run
  std::size_t robots = 0;
  std::uint64_t steps = 0;
  double sim_time_s = 0;
  double wall_s = 0;
  EndedBy ended_by = EndedBy::all_halted;
  std::string digest;
  GoldOutcome gold;
  double driven_m = 0;  ///< sum over all robots
  std::uint64_t stalls = 0;
  std::uint64_t messages = 0;          ///< delivered
  std::uint64_t messages_sent = 0;     ///< including those on their way
  std::uint64_t messages_dropped = 0;  ///< beyond a robot's limits on messages in a step
  MessageLosses messages_lost;
  std::uint64_t interventions = 0;          ///< applied
  std::optional<std::uint64_t> late;        ///< robot-steps whose command came too late; nullopt for a lockstep run
  std::optional<RunReport> report;          ///< of a served run
  std::vector<Metric> metrics;              ///< of the observers
  std::optional<ObserverEnd> observer_end;  ///< RunObservers::end()
  std::optional<RunEnd> intervention_end;   ///< State::ended

  /// Fills the fields derived from the run; the caller sets the rest.
  static RunSummary of(const LocalRun& run);
  double realTimeFactor() const { return wall_s > 0 ? sim_time_s / wall_s : 0; }
  nlohmann::ordered_json json() const;
  /// Text output of a few lines.
  std::string text() const;
};

}  // namespace robosim
