#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "recording/mcap_recording.h"
#include "recording/rawlog_reader.h"

namespace robosim {

/// A recording of RoboSim as an MCAP file, not yet under its name.
struct McapExport {
  std::unique_ptr<McapRecording> file;    ///< finished; commit() gives it its name
  std::optional<std::string> read_error;  ///< RawlogReader::readError()
  bool is_damaged = false;
};

/// Writes the topics of a recording, and its bytes as they are.
/// @param distribution whose messages are written
/// @param progress called with the number of steps so far; may throw to end the export
/// @param threads that decode the recording; the file is the same
/// @throws NotOfRoboSim; ConfigError as RawlogReader and McapRecording do, or without a world; RecordingError
McapExport exportMcap(const std::string& rawlog, const std::filesystem::path& out, RosDistribution distribution,
                      const std::function<void(std::uint64_t)>& progress, int threads = threadsForReading());

}  // namespace robosim
