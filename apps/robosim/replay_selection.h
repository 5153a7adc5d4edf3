#pragma once
#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"
#include "robosim/replay.h"

namespace robosim {

/// The observations of a recording that a person asks for.
class Selection {
 public:
  explicit Selection(const ReplayArguments& arguments) : arguments_(arguments) {}

  /// Whether the next observation is one of them.
  bool takes(const mrpt::obs::CObservation& observation, const RawlogReader& reader);
  /// When the last observation that takes() has seen was made [s].
  double time() const { return time_s_; }
  /// How much of the recording takes() has seen [s].
  double duration() const { return is_empty_ ? 0 : latest_s_ - earliest_s_; }

  /// @throws ConfigError when something was asked for and there was nothing of it: what there is instead.
  void checkFound() const;

 private:
  const ReplayArguments& arguments_;
  ObservationTimes times_;
  double time_s_ = 0;
  double earliest_s_ = std::numeric_limits<double>::infinity(), latest_s_ = -earliest_s_;
  bool is_empty_ = true, has_found_ = false;
  std::set<std::string> robots_, sensors_;  ///< all that there are
};

}  // namespace robosim
