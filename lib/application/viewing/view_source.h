#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/rereadable_file.h"
#include "environment/environment.h"
#include "environment/world_changes.h"
#include "net/connect.h"
#include "recording/recorded_step.h"
#include "rendering/drawn_run.h"
#include "rendering/run_paths.h"
#include "robots/run_snapshot.h"
#include "robots/world_source.h"
#include "world/intervention.h"

namespace robosim {

/// Source of the snapshots of a view: a world file or a map, a recording, or a served run.
class ViewSource {
 public:
  virtual ~ViewSource() = default;

  /// Changes together with worldNumber().
  virtual const LoadedWorld& world() const = 0;
  virtual int worldNumber() const { return 0; }
  virtual const RunSnapshot& snapshot() const = 0;
  /// Paths of the robots of world(): for a recording, of all of it; else of the steps so far.
  virtual const RunPaths& paths() const = 0;
  /// Events of the robots so far; for a recording, of all of it. Default: none.
  virtual const RunEvents& events() const {
    static const RunEvents none;
    return none;
  }
  /// Input files of the source.
  virtual std::vector<std::filesystem::path> inputs() const { return {}; }
  /// Title of the window.
  virtual std::string title() const = 0;

  /// Advances by wall time. @return whether the snapshot has changed
  /// @throws ConnectionError, RecordingError
  virtual bool advance(double wall_s) = 0;
  /// Whether no further snapshots will follow.
  virtual bool isOver() const = 0;
  /// Message for the user, or empty: why a recording ends early, that a run is over.
  virtual std::string remark() const { return ""; }
  /// Of a recording whose rest is still being read: the time up to which it has been [s]. Until then, it is played as
  /// far as it is known, and its duration and paths are those of this part.
  virtual std::optional<double> readSoFar() const { return std::nullopt; }
  /// Whether it is a recording of another program, in which sensors measure at other times than the snapshots.
  virtual bool isOfOtherProgram() const { return false; }
  /// Whether a recording is damaged, and only its readable entries are shown.
  virtual bool isDamaged() const { return false; }

  /// @name Playback control, if canPlay()
  ///@{
  virtual bool canPlay() const { return false; }
  virtual bool isPaused() const { return false; }
  virtual void pause(bool) {}
  /// Pauses, and makes the next advance(0) go to the next moment.
  virtual void step() {}
  virtual double speed() const { return 1; }  ///< seconds per second; 0: unlimited
  virtual void setSpeed(double) {}
  ///@}
  /// @name Recordings only, in seconds
  ///@{
  virtual std::optional<double> duration() const { return std::nullopt; }
  virtual void seek(double /*time_s*/) {}
  /// Returns `time_s`; or, if that has been inside a long gap without observations for a while, the gap's end. A clock
  /// that was set during recording leaves gaps of years.
  /// @param speed recorded seconds per second
  virtual double pastGap(double time_s, double /*speed*/) const { return time_s; }
  ///@}

  /// @name Changes of a run from outside
  ///@{
  /// Why the source cannot be changed from here; empty if it can, as far as is known.
  virtual std::string whyUnchangeable() const {
    return "only a run can be changed: one of 'robosim run --view', or a served one";
  }
  /// Requests a change before the next step. @pre whyUnchangeable() is empty
  virtual void change(const Change&) {}
  /// The answers since the last call, in the order of the requests: why a change was refused; empty for one that has
  /// been made.
  virtual std::vector<std::string> takeAnswers() { return {}; }
  ///@}

  /// Selects the robots whose readings are shown: flags by robot; empty for all.
  virtual void requestReadings(const std::vector<std::uint8_t>&) {}
};

/// How much of a recording is read before it is shown.
enum class Opening {
  whole,
  at_once,  ///< the first moment; the rest in a thread of its own
};

/// Snapshot of the latest step of an environment in this process, with all readings.
RunSnapshot takeSnapshot(const Environment& environment);

/// A world in its initial state; a map file stands for a world that consists of this map only.
/// @param changes of the world
/// @param seed of random places and of noise, as in a run
std::unique_ptr<ViewSource> viewWorld(const std::string& file, const WorldChanges& changes = {},
                                      std::uint64_t seed = 1);
/// The same for the text of a world file.
std::unique_ptr<ViewSource> viewWorld(const std::string& file, std::string text, std::uint64_t seed = 1);
/// A recording made by RoboSim or by another program.
/// @param name for the title @param pictures of cameras in the snapshots
/// @param opening of a recording of RoboSim; others are read in full
std::unique_ptr<ViewSource> viewRawlog(const std::string& name, std::unique_ptr<RereadableFile> file,
                                       Pictures pictures = Pictures::leave_out, Opening opening = Opening::whole);
/// A served run; the environment never waits for viewers.
std::unique_ptr<ViewSource> viewEnvironment(const ConnectOptions& connect_options);

/// @param what the source is: "a recording" @throws ConfigError unless there are no changes
void refuseChanges(const std::string& source, const WorldChanges& changes, const char* what);

/// Any of these: an address (HOST:PORT), a map by its file name, or a file recognised as a world or a rawlog by its
/// content.
/// @param connect_options for the given address; called only for an address
/// @param seed of the changes, and of what the world scatters
/// @param pictures, opening of a recording
/// @throws ConfigError when it is none of them, and for changes of anything but a world or a map.
std::unique_ptr<ViewSource> openView(const std::string& source,
                                     const std::function<ConnectOptions(const std::string& address)>& connect_options,
                                     const WorldChanges& changes = {}, std::uint64_t seed = 1,
                                     Pictures pictures = Pictures::leave_out, Opening opening = Opening::whole);

}  // namespace robosim
