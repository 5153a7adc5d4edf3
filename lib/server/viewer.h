#pragma once
#include <memory>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "net/dial.h"
#include "net/viewing.pb.h"
#include "robots/world_source.h"

namespace robosim {

/// What a viewer sees of a robot.
struct RobotLook {
  mrpt::math::TPose2D world_from_robot;
  float laser_pan_rad = 0;
  bool stalled = false;
  Activity activity = Activity::active;
  bool operator==(const RobotLook&) const = default;
};

/// What a viewer knows of a run: the world, and its robots at one step.
struct Sight {
  LoadedWorld world;
  std::string world_version;
  std::uint64_t step = 0;
  double time_s = 0;
  std::vector<RobotLook> robots;  ///< in the world's order
  std::string winner;             ///< the robot that has won; empty for as long as none has
};

void encode(const RobotLook& look, std::size_t robot, wire::RobotView& out);

/// Takes over what a frame tells: all of it, or what has changed.
/// @return whether the world is another
/// @throws WireError for a frame that makes no sense, ConfigError for a world that cannot be built here.
bool update(Sight& sight, const wire::Frame& frame);

/// A viewer's end of the connection: asks for a frame whenever its owner wants one, and so never gets more than it can
/// take. Used by one thread.
class Viewer {
 public:
  /// Connects, and waits for the whole state.
  /// @throws ConnectionError when nobody answers, or the environment will not have this viewer.
  explicit Viewer(const DialOptions& dial_options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  const Sight& sight() const;

  /// Waits for a step newer than the one in sight, and takes the newest.
  /// @return false when the run is over; the last step remains in sight
  /// @throws ConnectionError when the environment hangs up, or is gone.
  bool look();
  /// Whether the last look showed another world.
  bool isOtherWorld() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
