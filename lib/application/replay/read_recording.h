#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "recording/rawlog_reader.h"
#include "replay/recording_figure.h"
#include "replay/recording_page.h"
#include "replay/recording_table.h"

namespace robosim {

/// What is read of a recording.
struct RecordingParts {
  bool table = true;  ///< all numbers of all observations
  bool figure = false;
  bool page = false;
  ViewLayers layers = {};    ///< that the page shows at first
  RobotSelection only = {};  ///< robots that the page contains
};

/// The observations of a recording in memory.
struct RecordingContents {
  std::optional<RecordingTable> table;           ///< as RecordingParts::table
  std::optional<RecordingFigure> figure;         ///< as RecordingParts::figure
  std::optional<RecordingPage> page;             ///< as RecordingParts::page
  std::optional<std::string> read_error;         ///< RawlogReader::readError()
  bool is_damaged = false;                       ///< RawlogReader::isDamaged()
  std::vector<std::string> unread, assumptions;  ///< as of RawlogReader
};

/// Reads a recording made by RoboSim or another program.
/// @param threads that decode it @param progress called with the number of entries so far; may throw to end the
/// reading; empty: none
/// @throws ConfigError for a file that is no rawlog, or above RecordingTable::kMaxValues
RecordingContents readRecording(const std::string& rawlog, const RecordingParts& parts = {},
                                const std::function<void(std::uint64_t)>& progress = {},
                                int threads = threadsForReading());

}  // namespace robosim
