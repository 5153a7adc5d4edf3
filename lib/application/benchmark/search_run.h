#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "benchmark/survival.h"
#include "run/run_summary.h"

namespace robosim {

/// Result of one run, such as a search for gold. All but the duration depends only on the plan.
struct SearchRun {
  std::size_t case_index = 0;  ///< SearchPlan::caseAt(), SweepPlan::caseAt()
  std::uint64_t seed = 0;
  std::size_t robots = 0;
  double sim_time_s = 0;
  std::string ended_by;    ///< nameOf(EndedBy)
  std::string end_reason;  ///< of the observer that ended it; else empty
  std::optional<std::string> found_by;
  std::optional<double> found_s;
  std::optional<double> all_halted_s;
  double driven_m = 0;  ///< all robots
  std::uint64_t stalls = 0;
  std::uint64_t messages_sent = 0;
  std::uint64_t messages_delivered = 0;
  std::uint64_t messages_lost = 0;
  std::vector<Metric> metrics;  ///< of the observers; finite or NaN
  std::string digest;
  double wall_s = 0;  ///< duration; not part of json()

  static SearchRun of(std::size_t case_index, const RunSummary& summary);
  /// Time to the gold. A search without success is censored at the time limit also if it ended earlier: its robots had
  /// broken down, and would not have found the gold later either.
  SearchTime searchTime(double limit_s) const { return {found_s.value_or(limit_s), found_s.has_value()}; }
  /// Value of a metric by name; NaN for none.
  double metric(const std::string& name) const;

  nlohmann::ordered_json json() const;
  /// @throws std::exception for a document that json() cannot have made
  static SearchRun fromJson(const nlohmann::ordered_json& json);
};

/// Numbered runs that depend on a plan only. With equal files, each can be made by any thread of any process.
class NumberedRuns {
 public:
  virtual ~NumberedRuns() = default;
  virtual std::size_t runCount() const = 0;
  /// @param index below runCount(); may be called from several threads
  /// @return nullopt when interrupted
  /// @throws ConfigError, ControllerError, ObserverError
  virtual std::optional<SearchRun> run(std::size_t index, const std::function<bool()>& is_interrupted) const = 0;
  /// All that the results depend on, as bytes.
  virtual std::string planText() const = 0;
};

/// Names of metrics of the observer `effort`.
inline constexpr const char* kEnergyMetric = "effort.energy_wh";
inline constexpr const char* kBytesMetric = "effort.message_bytes";
inline constexpr const char* kVisitedMetric = "effort.visited_m2";
inline constexpr const char* kOverlapMetric = "effort.overlap";

}  // namespace robosim
