#pragma once
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/error_list.h"
#include "robots/world_source.h"
#include "run/local_run.h"

namespace robosim {

/// Error: a recording without a RunNote.
class NotOfRoboSim : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

/// Metadata of a recording: everything needed to repeat the run. Stored as JSON in a CObservationComment at the start
/// of the recording and, with the outcome, at its end (doc/rawlog.md).
struct RunNote {
  WorldSource world;  ///< without text if it is too large to be stored
  /// The same without its files, such as maps, and also stored where these are too large.
  WorldSource without_files;
  std::string world_version;  ///< versionOf(world)
  std::uint64_t seed = 1;
  double period_s = 0.1;
  std::uint64_t first_step = 0;          ///< greater than 0 when the recording was started during the run
  std::vector<std::string> controllers;  ///< by robot, in the world's order; empty if driven by another process
  std::string controller_of_added;       ///< of robots that interventions add and that name none
  /// Which robots that interventions add are driven by another process.
  enum class Elsewhere { none, without_controller, all } added_elsewhere = Elsewhere::none;
  nlohmann::ordered_json outcome;  ///< as RunSummary::json(); null until the run ends

  std::string text() const;
  /// nullopt if the comment is no such note.
  static std::optional<RunNote> parse(const std::string& text);
  /// The first note of a recording.
  /// @throws NotOfRoboSim when the recording has none, so that it was made by another program.
  static RunNote of(const std::string& rawlog);
};

/// The note at the start of this run's recording.
/// @param elsewhere by robot: whether it is driven by another process; empty for none
RunNote makeNote(const WorldSource& source, const LocalRun& run, const RunOptions& options,
                 const std::vector<std::uint8_t>& elsewhere = {});

}  // namespace robosim
