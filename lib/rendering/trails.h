#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "robots/run_snapshot.h"

namespace robosim {

/// A point of a robot's trail.
struct TrailPoint {
  mrpt::math::TPoint2D at;
  bool is_after_gap = false;  ///< the path from the previous point is unknown
};

/// Trails of all robots since the start of a run, as points a few centimetres apart. When a robot's trail exceeds the
/// maximum number of points, every second point is dropped and the spacing doubles. Points are joined by straight
/// lines, also across steps that were not observed (seeking in a recording, runs faster than the frame rate) up to 1 m;
/// a longer step starts after a gap, because a wall may lie in between.
class Trails {
 public:
  /// @param max_points per robot
  explicit Trails(std::size_t max_points = 8000) : max_points_(max_points) {}

  void add(const RunSnapshot& snapshot);
  void clear() {
    of_robot_.clear();
    spacing_m_.clear();
  }
  /// By robot, the oldest first.
  const std::vector<std::vector<TrailPoint>>& ofRobot() const { return of_robot_; }

 private:
  std::size_t max_points_;
  std::uint64_t last_step_ = 0;
  std::vector<std::vector<TrailPoint>> of_robot_;
  std::vector<double> spacing_m_;  ///< by robot
};

}  // namespace robosim
