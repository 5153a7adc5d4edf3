#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "replay/recording_table.h"

namespace robosim {

/// All observations of a recording in memory.
struct RecordingContents {
  RecordingTable table;
  std::optional<std::string> damage;  ///< at which reading ended; nullopt for an undamaged file
};

/// Reads a recording made by RoboSim or another program.
/// @param progress called with the number of entries so far; may throw to end the reading; empty: none
/// @throws ConfigError for a file that is no rawlog, or above RecordingTable::kMaxValues
RecordingContents readRecording(const std::string& rawlog, const std::function<void(std::uint64_t)>& progress = {});

}  // namespace robosim
