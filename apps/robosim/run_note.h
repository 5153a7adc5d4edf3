#pragma once
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/error_list.h"
#include "robosim/local_run.h"
#include "robots/world_source.h"

namespace robosim {

/// A recording that does not say what it is of.
class NotOfRoboSim : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

/// What a recording says of the run that it is of: all that is needed to run it again. Kept as JSON in a
/// CObservationComment, at the recording's beginning, and once more, with the outcome, at its end (doc/rawlog.md).
struct RunNote {
  WorldSource world;
  std::string world_version;  ///< versionOf(world)
  std::uint64_t seed = 1;
  double period_s = 0.1;
  std::vector<std::string>
      controllers;                 ///< by robot, in the world's order; empty for one that was driven from elsewhere
  nlohmann::ordered_json outcome;  ///< as RunSummary::json(); null while the run goes on

  std::string text() const;
  /// nullopt for what is no such note.
  static std::optional<RunNote> parse(const std::string& text);
  /// The first note of a recording.
  /// @throws NotOfRoboSim when the recording has none: it is somebody else's.
  static RunNote of(const std::string& rawlog);
};

/// What a recording of this run begins with.
/// @param elsewhere by robot: whether something outside of this process drives it; empty for none
RunNote noteOf(const WorldSource& source, const LocalRun& run, const RunOptions& options,
               const std::vector<std::uint8_t>& elsewhere = {});

}  // namespace robosim
