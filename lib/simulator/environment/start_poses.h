#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// Random start poses for the robots of a fleet. Positions are reachable from the world's own starts (so that a task
/// stays solvable) and touch nothing; headings are uniform. Reachability is computed once, for the widest robot, on a
/// raster of half its radius.
///
/// Starts keep a distance from the gold (every hot object), from the robot's center to the gold's outline: at least
/// World::start_distance_m. Without one, the range of the robots' heat sensors, or the distance at which a robot wins
/// if that is longer, so that no robot begins beside the gold; in a world in which fewer than a tenth of the places are
/// so far away, those of the farthest tenth. Robots for which these leave no room then start as far away as possible.
class RandomStarts {
 public:
  /// @throws ConfigError for a world of more than 1e8 raster cells
  RandomStarts(const World& world, const Fleet& fleet);
  /// A pose for each robot, which depends only on the seed. @throws ConfigError when there is not enough space
  std::vector<mrpt::math::TPose2D> draw(std::uint64_t seed) const;
  /// Distance from the gold that the starts keep [m], unless there is too little room; 0 without gold.
  double distance() const { return distance_m_; }

 private:
  struct Place {
    mrpt::math::TPoint2D at;
    double distance_m;  ///< from the gold; infinite without
  };
  void chooseDistance(const World& world, const Fleet& fleet);
  bool isClear(const mrpt::math::TPoint2D& place, const std::vector<mrpt::math::TPose2D>& starts) const;

  std::string world_name_;
  std::size_t robots_;
  double radius_m_ = 0;
  double distance_m_ = 0;
  std::optional<double> required_distance_m_;  ///< World::start_distance_m
  std::vector<Place> places_;
  std::vector<Place> nearer_;  ///< those of places_ that are nearer than distance_m_, the farthest first
};

/// Moves the robots of a fleet, in its order. @param starts one for each robot
void setStartPoses(Fleet& fleet, std::span<const mrpt::math::TPose2D> starts);

/// Moves every robot of the fleet to a random start pose (RandomStarts).
void shuffleStartPoses(const World& world, Fleet& fleet, std::uint64_t seed);

}  // namespace robosim
