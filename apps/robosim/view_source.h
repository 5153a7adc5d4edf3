#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "environment/environment.h"
#include "rendering/shown.h"
#include "robosim/connection.h"
#include "robots/world_source.h"

namespace robosim {

/// Where a view has its moments from: a world file or a map, a recording, or a run that goes on elsewhere.
class ViewSource {
 public:
  virtual ~ViewSource() = default;

  /// Another one after worldNumber() has changed.
  virtual const LoadedWorld& world() const = 0;
  virtual int worldNumber() const { return 0; }
  virtual const Shown& shown() const = 0;
  /// What the window's title says.
  virtual std::string title() const = 0;

  /// Goes on by some time of the clock. @return whether another moment is shown now
  /// @throws ConnectionError, RecordingError
  virtual bool advance(double wall_s) = 0;
  /// Whether nothing more will come.
  virtual bool isOver() const = 0;
  /// A word for the person who looks, when there is one: why a recording ends early, that a run is over.
  virtual std::string remark() const { return ""; }

  /// @name What a person may do, as far as canPlay() allows
  ///@{
  virtual bool canPlay() const { return false; }
  virtual bool isPaused() const { return false; }
  virtual void pause(bool) {}
  /// Halts, and goes on to the next moment with advance(0).
  virtual void step() {}
  virtual double speed() const { return 1; }  ///< seconds a second; 0: as fast as it can
  virtual void setSpeed(double) {}
  ///@}
  /// @name Of a recording, in seconds
  ///@{
  virtual std::optional<double> duration() const { return std::nullopt; }
  virtual void seek(double /*time_s*/) {}
  /// A time to be shown; or, when it lies in a long gap in which nothing was recorded and has been still for a while,
  /// when that ends. Clocks that were set while a robot recorded leave gaps of years.
  /// @param speed recorded seconds per second
  virtual double pastGap(double time_s, double /*speed*/) const { return time_s; }
  ///@}

  /// Whose sensors are shown: by robot, 1 for those; empty for all.
  virtual void want(const std::vector<std::uint8_t>&) {}
};

/// The newest step of an environment in this process, with everybody's readings.
Shown shownOf(const Environment& environment);

/// A world as it begins; a map's file stands for a world that is nothing but this map.
std::unique_ptr<ViewSource> viewWorld(const std::string& file);
/// A recording, of RoboSim's or anybody's.
std::unique_ptr<ViewSource> viewRawlog(const std::string& file);
/// A run that goes on; the environment never waits for its viewers.
std::unique_ptr<ViewSource> viewEnvironment(const ConnectionArguments& connection);

/// Any of them: an address (HOST:PORT), a map by its name, or a file that begins as a world or a rawlog does.
/// @throws ConfigError when it is none.
std::unique_ptr<ViewSource> openView(const std::string& source, ConnectionArguments connection);

}  // namespace robosim
