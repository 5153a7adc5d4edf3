#pragma once
#include <memory>
#include <string>
#include <vector>

#include "rendering/drawn_run.h"
#include "rendering/run_paths.h"
#include "robots/run_snapshot.h"
#include "robots/world_source.h"

namespace robosim {

/// Index of the moments of a recording. The file is read once in full; a few numbers are kept per moment, and a moment
/// is read again when it is shown.
class RecordedMoments {
 public:
  virtual ~RecordedMoments() = default;

  /// For RoboSim's recordings, the recorded world; for others, only robots.
  virtual const LoadedWorld& world() const = 0;
  /// Time of each moment [s], ascending; at least one.
  virtual const std::vector<double>& times() const = 0;
  /// @throws RecordingError when the file has changed.
  virtual RunSnapshot at(std::size_t moment) = 0;
  /// Paths of the robots through all moments.
  virtual const RunPaths& paths() const = 0;
  /// Events of the robots in all moments; empty for recordings of other programs.
  virtual const RunEvents& events() const = 0;
  /// Reason for an early end, and what was left out; empty for a complete file.
  virtual const std::string& readError() const = 0;
  /// RawlogReader::isDamaged(), of the whole file.
  virtual bool isDamaged() const = 0;
};

/// Opens a recording made by RoboSim or by another program.
/// @throws ConfigError as RawlogReader does, or when the recording has nothing that can be shown.
std::unique_ptr<RecordedMoments> readMoments(const std::string& file);

}  // namespace robosim
