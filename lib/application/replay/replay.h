#pragma once
#include <optional>
#include <string>
#include <vector>

#include "recording/rawlog_reader.h"

namespace robosim {

/// What to read of a recording, and what to do with it.
struct ReplayArguments {
  std::string rawlog;
  std::vector<std::string> robots;     ///< selected; empty for all
  std::vector<std::string> sensors;    ///< selected by the second part of the label; empty for all
  std::optional<double> from_s, to_s;  ///< since the recording's first observation
  bool index = false;                  ///< print only what the index of an MCAP file says
  bool print = false;
  bool csv = false;                    ///< print as comma-separated values
  std::string ground_truth;            ///< output file
  std::string output;                  ///< rawlog of the selected observations
  double speed = 0;                    ///< of printing: recorded seconds per second; 0: unlimited
  std::string controller;              ///< of the world of the recording; "recorded": each robot's own
  std::string check;                   ///< a world file
  std::vector<std::string> observers;  ///< of the repeated run, as TypeChoice::text()
  double tolerance = 1e-9;
  bool json = false;
  int threads = threadsForReading();  ///< that decode the recording; the results are the same

  bool selects(const std::string& robot, const std::string& sensor) const;
};

enum class ReplayResult {
  complete,   ///< of a complete recording, or of one that is only cut off
  damaged,    ///< of the readable part of a damaged recording
  different,  ///< of checkRun(): the run is another one
};

inline ReplayResult resultOf(const RawlogReader& reader) {
  return reader.isDamaged() ? ReplayResult::damaged : ReplayResult::complete;
}

/// Prints what was not read of a recording as warnings.
void warnOf(const RawlogReader& reader);

/// Thrown when a replay is interrupted.
[[noreturn]] void failInterrupted(double read_s);

/// Summarises a recording made by RoboSim or another program.
ReplayResult summarise(const ReplayArguments&);
/// Prints topics, times, and what an MCAP file says about the run, of any program, by its index: the messages are not
/// read. @throws ConfigError for a file without an index
ReplayResult printIndex(const ReplayArguments&);
/// Prints the observations, one line each, at the requested speed.
ReplayResult printObservations(const ReplayArguments&);
/// Writes a robot's true path as a text file that MRPT's pf-localization and CPose3DInterpolator read: one line "time x
/// y z yaw pitch roll" per pose, in seconds since 1970, metres and radians.
/// @throws ConfigError when several robots are selected, or the recording has no ground truth.
ReplayResult writeGroundTruth(const ReplayArguments&);
/// Writes the selected observations to a rawlog.
/// @throws ConfigError when the selection matches nothing.
ReplayResult writeSelection(const ReplayArguments&);
/// Repeats the run, in the world `check` or else the recorded one, and reports whether it is identical and the metrics
/// of the observers. They see what they would have seen in the recorded run.
/// @throws ConfigError when the recording contains no world, and none is given
ReplayResult checkRun(const ReplayArguments&);
/// Feeds the recorded readings to a controller, and reports where its commands differ from the recorded ones.
ReplayResult replayToController(const ReplayArguments&);

}  // namespace robosim
