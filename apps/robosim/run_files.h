#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "robots/world_source.h"
#include "run/run_arguments.h"

namespace robosim {

/// Settings of `robosim run`.
struct LocalRunArguments : RunArguments {
  std::string csv, npz;              ///< files; empty for none
  std::uint64_t balance_steps = 50;  ///< DistributionOptions::balance_steps
  std::string exchange = "auto";     ///< DistributionOptions::exchange

  bool isRecorded() const { return !record.empty() || !csv.empty() || !npz.empty(); }
  bool writesFiles() const { return isRecorded() || !picture.empty(); }
};

/// What a run writes: its files, and its summary on standard output.
class RunFiles {
 public:
  virtual ~RunFiles() = default;
  /// Records the current step. @throws RecordingError
  virtual void observe() = 0;
  /// Completes the files of a failed run.
  virtual void keep() = 0;
  /// Completes the files, and prints the summary. @param wall_s elapsed time of the run
  virtual void finish(double wall_s, EndedBy ended_by) = 0;
};

}  // namespace robosim

/// In librobosim-program, which a run that writes no files does not load.
/// @param source of the world; null if nothing is recorded @return to be deleted @throws ConfigError
extern "C" robosim::RunFiles* robosimMakeRunFiles(const robosim::LocalRunArguments& arguments,
                                                  const robosim::LocalRun& run, const robosim::WorldSource* source);
