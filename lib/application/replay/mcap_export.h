#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "recording/mcap_recording.h"

namespace robosim {

/// A recording of RoboSim as an MCAP file, not yet under its name.
struct McapExport {
  std::unique_ptr<McapRecording> file;    ///< finished; commit() gives it its name
  std::optional<std::string> read_error;  ///< RawlogReader::readError()
  bool is_damaged = false;
};

/// Writes the topics of a recording, and its bytes as they are.
/// @param progress called with the number of steps so far; may throw to end the export
/// @throws NotOfRoboSim; ConfigError as RawlogReader and McapRecording do, or without a world; RecordingError
McapExport exportMcap(const std::string& rawlog, const std::filesystem::path& out,
                      const std::function<void(std::uint64_t)>& progress);

}  // namespace robosim
