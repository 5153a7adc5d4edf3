#pragma once
#include <cmath>
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

namespace robosim {

/// Sampled path of every robot of a run: a point every few centimetres.
class Tracks {
 public:
  explicit Tracks(std::size_t robots) : points_(robots) {}

  /// @param world_from_robot kNotShown for absent robots, whose path begins again when they come back
  void add(std::span<const mrpt::math::TPose2D> world_from_robot) {
    constexpr double kSpacing_m = 0.05;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (std::isnan(world_from_robot[i].x)) {
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
