#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error_list.h"
#include "environment/environment.h"
#include "environment/run_report.h"
#include "robots/world_source.h"
#include "server/run_control.h"
#include "server/run_info.h"

namespace robosim {

/// A run that can replace the one that is served.
class PreparedRun {
 public:
  virtual ~PreparedRun() = default;
};

/// State of a run's recording.
struct RecordingStatus {
  enum class State {
    none,  ///< the run cannot be recorded, because it has no name for recordings
    on,
    off,
  };
  State state = State::none;
  std::string file{};     ///< current or last file, its name without folder; empty while there is none
  std::string failure{};  ///< why the last recording ended before it was stopped; empty if it did not
};

/// Interface between EnvironmentServer and a run: the environment, and callbacks for each step.
class ServedRun {
 public:
  virtual ~ServedRun() = default;
  virtual Environment& environment() = 0;
  /// The part of the run that is served to clients.
  virtual std::shared_ptr<const RunInfo> runInfo() const = 0;
  /// Called between steps after robots have been added to the environment: runInfo() has them afterwards.
  virtual void addRobots() {}
  /// Called at least every ServingState::kPollInterval, between steps, also while the run is paused: serves clients
  /// that are not the server's, which may change how the run proceeds.
  virtual void poll(RunControl& /*control*/) {}
  /// A run that a client of the run itself has requested and that is ready to replace this one, once; null for none.
  /// Called after poll().
  virtual std::unique_ptr<PreparedRun> takeRequestedRun() { return nullptr; }
  /// Requests pictures of robots for clients, in addition to those that the run itself needs: flags by robot, until the
  /// next call. Those of the present step are taken if they have not been. No effect by default.
  virtual void requestPictures(const std::vector<std::uint8_t>& /*robots*/) {}
  /// Runs the environment's own controllers; called immediately before a step.
  virtual void decide() = 0;
  /// Called after each step, for example to record it. @param late number of robots whose commands were too late
  virtual void stepped(std::size_t late) = 0;
  virtual bool isOver() const = 0;
  virtual RecordingStatus recording() const { return {}; }
  /// Starts or stops the recording, between two steps; no effect when it is already so.
  /// @throws ConfigError when it cannot be started, or the file cannot be completed; the recording is then off.
  virtual void setRecording(bool /*on*/) {
    throw ConfigError("the run is not recorded: robosim serve was started without --record");
  }
  /// Called when the run ends or is about to be replaced.
  virtual void ends(const RunReport& report) = 0;
  /// Builds another run, with the world's seed, or this run's if it has none. Called on another thread while this run
  /// continues; must not modify this run.
  /// @throws ConfigError when the world is invalid; any other exception refuses the world, too.
  virtual std::unique_ptr<PreparedRun> prepare(const WorldSource& world) const = 0;
  /// Opens what a prepared run needs besides, such as ports. Called on the stepping thread, after prepare(). Everything
  /// that can fail belongs here or into prepare(): after any exception, this run continues.
  virtual void makeReady(PreparedRun& /*next*/) const {}
  /// Replaces this run by one that is ready. The previous runInfo() stays valid for its holders.
  virtual void replace(std::unique_ptr<PreparedRun> next) = 0;
};

}  // namespace robosim
