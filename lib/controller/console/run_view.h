#pragma once
#include <string>
#include <vector>

namespace robosim {

/// State of the run's recording.
struct RecordingView {
  enum class State {
    none,  ///< never observed, or the environment was started without a name for recordings
    on,
    off,
  };
  State state = State::none;
  std::string file{};  ///< current or last file, its name without folder; empty while there is none
  /// Whether setRecording() may succeed: the run is not over, and the console's own token is an operator's.
  bool may_change = false;
  bool is_changing = false;
  std::string problem{};  ///< why the last change has failed; empty when it has not
  std::string failure{};  ///< why the last recording ended before it was stopped; empty if it did not
  bool operator==(const RecordingView&) const = default;
};

/// State of the environment's run, as far as the console can observe it.
struct RunView {
  enum class Phase {
    unknown,  ///< never observed: the address is wrong, or the token permits no status
    gone,     ///< observed before, and no status has arrived for a second
    waiting,  ///< for robots' processes: `absent`
    paused,
    running,
    ended,
  };
  Phase phase = Phase::unknown;
  std::string problem{};              ///< why there is no status; empty while there is
  std::vector<std::string> absent{};  ///< robots without a process, of those in other processes
  /// Whether restart() can start the next run: this one is over, the environment still serves, and the console's own
  /// token is an operator's.
  bool may_restart = false;
  /// Whether restart() can replace the run that is not over, which only rounds of visitors do.
  bool may_replace = false;
  bool is_restarting = false;
  std::string restart_problem{};  ///< why the last restart has failed; empty when it has not
  RecordingView recording{};
  bool operator==(const RunView&) const = default;
};

/// Source of the run's state. Called from one thread.
class RunSource {
 public:
  virtual ~RunSource() = default;
  virtual RunView newest() = 0;
  /// Ends the run if it is not over, and loads its world again. Does not block: newest() contains the result.
  /// @param paused whether the new run waits for resume(); otherwise it is started
  virtual void restart(bool paused) = 0;
  /// Starts the new run. Does not block.
  virtual void resume() = 0;
  /// Starts or stops the recording. Does not block: newest() contains the result.
  virtual void setRecording(bool on) = 0;
};

}  // namespace robosim
