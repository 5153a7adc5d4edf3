#pragma once
#include <optional>
#include <string>
#include <vector>

namespace robosim {

/// What a person says of a recording to be replayed.
struct ReplayArguments {
  std::string rawlog;
  std::vector<std::string> robots;     ///< only these; empty for all
  std::vector<std::string> sensors;    ///< only these, by the second half of their labels; empty for all
  std::optional<double> from_s, to_s;  ///< since the recording's first observation
  bool print = false;
  std::string speed = "max";
  std::string controller;  ///< of the world of the recording; "recorded": each robot's own
  std::string check;       ///< a world file
  double tolerance = 1e-9;
  bool json = false;

  bool wants(const std::string& robot, const std::string& sensor) const;
};

/// Ends a replay that was interrupted.
[[noreturn]] void failInterrupted(double read_s);

/// Says what is in a recording, ours or anybody's.
void summarise(const ReplayArguments&);
/// Prints its observations, a line each, at the speed asked for.
void printObservations(const ReplayArguments&);
/// Runs the world again, and says whether it is the same run; if not, ends with kRunFailed.
void checkRun(const ReplayArguments&);
/// Feeds the recorded readings to a controller, and tells where its commands differ from the recorded ones.
void replayToController(const ReplayArguments&);

}  // namespace robosim
