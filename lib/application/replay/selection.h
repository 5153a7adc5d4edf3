#pragma once
#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <unordered_map>

#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"
#include "replay/replay.h"

namespace robosim {

/// Filter of a recording's observations by robot, sensor and time.
class Selection {
 public:
  explicit Selection(const ReplayArguments& arguments) : arguments_(arguments), times_(arguments.rawlog) {}

  /// Whether the next observation is selected.
  bool takes(const mrpt::obs::CObservation& observation, const RawlogReader& reader);
  /// Time of the last observation passed to takes() [s].
  double time() const { return time_s_; }
  /// Duration of the recording passed to takes() so far [s].
  double duration() const { return is_empty_ ? 0 : latest_s_ - earliest_s_; }

  /// @throws ConfigError when a selection matches nothing; the text lists the available names.
  void checkFound() const;

 private:
  const ReplayArguments& arguments_;
  ObservationTimes times_;
  double time_s_ = 0;
  double earliest_s_ = std::numeric_limits<double>::infinity(), latest_s_ = -earliest_s_;
  bool is_empty_ = true, has_found_ = false;
  std::set<std::string> robots_, sensors_;         ///< all names in the recording
  std::unordered_map<std::string, bool> selects_;  ///< whether robot and sensor are selected, by label
};

}  // namespace robosim
