#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recording/rawlog_writer.h"
#include "robosim/cli11_names.h"
#include "robosim/local_run.h"
#include "robosim/run_note.h"
#include "robosim/run_summary.h"
#include "robosim/tracks.h"

namespace robosim {

/// What a person says of a run, whether its robots are all in this process or not.
struct RunArguments {
  std::string world;
  RunOptions run;
  double time_s = 1800;
  std::string speed = "max";
  std::string record;
  std::string rawlog_format = "obs";
  std::string record_images = "embedded";
  std::string picture;
  bool json = false;

  /// @throws ConfigError for a slip that is better told before the work begins.
  void check() const;
  /// Whether the run has had its time.
  bool timeIsUp(const SimTime& now) const;
};

/// Adds WORLD and the options of RunArguments.
void addRunArguments(CLI::App& command, RunArguments& arguments);
/// The list of controllers, for the foot of a help text.
std::string controllersHelp();

/// What a run leaves behind: rawlog, picture and summary, as the arguments would have it.
class RunOutputs {
 public:
  /// Opens the recording. @param note that it begins with @throws ConfigError
  RunOutputs(const RunArguments& arguments, const Environment& environment, RunNote note);

  /// Keeps the step that stands. @throws RecordingError
  void observe(const Environment& environment);
  /// Closes the recording of a run that failed: what there is of it is what one wants to look at.
  void keep(const Environment& environment);
  /// Closes the recording, prints the summary, and draws the picture.
  /// @param late robot-steps whose command came too late; nullopt for a run that waits
  void finish(const LocalRun& run, double wall_s, EndedBy ended_by, std::optional<std::uint64_t> late = {});

 private:
  const RunArguments& arguments_;
  RunNote note_;
  std::vector<Command> commands_;  ///< of the step that stands
  std::unique_ptr<RawlogWriter> recording_;
  std::unique_ptr<Tracks> tracks_;
};

}  // namespace robosim
