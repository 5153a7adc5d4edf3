#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"

namespace robosim {

/// A robot as a view shows it.
struct ShownRobot {
  mrpt::math::TPose2D world_from_robot;
  float laser_pan_rad = 0;
  bool stalled = false;
  Activity activity = Activity::active;
  std::optional<Readings> readings;  ///< nullopt for one whose sensors nobody asked for
};

/// A moment of a run as views show it, wherever it comes from: a run that goes on, a recording, or a world's start.
struct Shown {
  std::uint64_t step = 0;
  double time_s = 0;
  std::vector<ShownRobot> robots;  ///< in the world's order
};

/// A point of the way that a robot has come.
struct TrailPoint {
  mrpt::math::TPoint2D at;
  bool is_after_gap = false;  ///< how it came from the point before is not known
};

/// The ways that robots have come, for views to draw: a point for every few centimetres; of the latest ones only. From
/// one step to the next they go straight; over steps that were not shown (a recording wound on, a run faster than
/// pictures) as well, up to 1 m: farther away, there may be a wall in between.
class Trails {
 public:
  /// @param most points a robot
  explicit Trails(std::size_t most = 2000) : most_(most) {}

  void add(const Shown& shown);
  void clear() { of_robot_.clear(); }
  /// By robot, the oldest first.
  const std::vector<std::vector<TrailPoint>>& ofRobot() const { return of_robot_; }

 private:
  std::size_t most_;
  std::uint64_t last_step_ = 0;
  std::vector<std::vector<TrailPoint>> of_robot_;
};

}  // namespace robosim
