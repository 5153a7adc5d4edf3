#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "robots/world_source.h"
#include "run/local_run.h"
#include "run/run_summary.h"

namespace robosim {

/// Recording of a run that begins with any step and whose caller takes the steps.
class SimulationRecording {
 public:
  virtual ~SimulationRecording() = default;
  /// Records the present state. @throws RecordingError
  virtual void observe(const Environment& environment) = 0;
  /// Completes the file. @throws RecordingError
  virtual void finish(const Environment& environment, const RunSummary& outcome) = 0;
};

/// Records the present state. @param elsewhere as of makeNote() @throws ConfigError, RecordingError
std::unique_ptr<SimulationRecording> recordSimulation(const std::filesystem::path& file, const WorldSource& source,
                                                      const LocalRun& run, const RunOptions& options,
                                                      const std::vector<std::uint8_t>& elsewhere);

}  // namespace robosim
