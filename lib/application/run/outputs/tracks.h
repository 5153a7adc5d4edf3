#pragma once
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"

namespace robosim {

/// Sampled path of every robot of a run: a point every few centimetres.
class Tracks {
 public:
  explicit Tracks(std::size_t robots) : points_(robots) {}

  /// The path of an absent robot begins again when it comes back.
  void add(std::span<const mrpt::math::TPose2D> world_from_robot, std::span<const Activity> activity) {
    constexpr double kSpacing_m = 0.05;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (activity[i] == Activity::absent) {
        points_[i].clear();
        continue;
      }
      const mrpt::math::TPoint2D now(world_from_robot[i].x, world_from_robot[i].y);
      if (points_[i].empty() || (now - points_[i].back()).norm() >= kSpacing_m) points_[i].push_back(now);
    }
  }

  /// By robot, in order of time.
  const std::vector<std::vector<mrpt::math::TPoint2D>>& points() const { return points_; }

 private:
  std::vector<std::vector<mrpt::math::TPoint2D>> points_;
};

}  // namespace robosim
