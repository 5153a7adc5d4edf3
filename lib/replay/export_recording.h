#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/interrupt.h"

namespace robosim {

/// Form of a recording for other programs; doc/rawlog.md specifies both.
enum class TableFormat {
  csv,  ///< comma-separated values, one row per robot and step
  npz,  ///< NumPy's arrays, for each robot and sensor
};

struct TableFile {
  std::filesystem::path file;
  TableFormat format;
};

/// Writes a recording as tables. All files are renamed to their names after all have been written.
/// @param rawlog made by RoboSim or another program; may be a pipe
/// @param interrupt a request ends the export; null: it cannot be interrupted
/// @throws ConfigError, Interrupted, std::runtime_error (such as on a full disk); nothing is written then
void exportRecording(const std::string& rawlog, const std::vector<TableFile>& outs, const Interrupt* interrupt);

}  // namespace robosim
