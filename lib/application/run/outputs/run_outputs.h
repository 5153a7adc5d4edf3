#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/local_run.h"
#include "run/outputs/run_note.h"
#include "run/outputs/run_recording.h"
#include "run/run_arguments.h"
#include "run/run_summary.h"

namespace robosim {

/// Output files of a run: rawlog, picture and summary, according to the arguments.
class RunOutputs {
 public:
  /// Opens the recording. @param note first entry of the recording @throws ConfigError
  RunOutputs(const RunArguments& arguments, const Environment& environment, RunNote note);
  ~RunOutputs();

  /// Records the current step. @throws RecordingError as RunRecording::write()
  void observe(const Environment& environment);
  /// null for a run without a name for recordings
  const RunRecording* recording() const { return recording_.get(); }
  /// Starts or stops the recording between two steps; no effect when it is already so. A file that is stopped ends with
  /// a note of the run so far.
  /// @throws ConfigError when it cannot be started @throws RecordingError when the file cannot be completed
  void setRecording(bool on, const LocalRun& run);
  /// Closes the recording of a failed run, keeping what was recorded.
  void keep(const Environment& environment);
  /// Closes the recording, draws the picture, and prints the summary, also before it throws.
  /// @throws RecordingError as RunRecording::finish() @throws std::runtime_error when the picture cannot be written
  /// @param late robot-steps whose command came too late; nullopt for a lockstep run
  /// @param report of a served run; else nullopt
  void finish(const LocalRun& run, double wall_s, EndedBy ended_by, std::optional<std::uint64_t> late = {},
              const std::optional<RunReport>& report = {});

 private:
  class Tracks;

  const RunArguments& arguments_;
  std::vector<Command> commands_;  ///< of the current step
  std::unique_ptr<RunRecording> recording_;
  std::unique_ptr<Tracks> tracks_;  ///< null without a picture
};

}  // namespace robosim
