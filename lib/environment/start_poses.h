#pragma once
#include <cstddef>
#include <cstdint>
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
class RandomStarts {
 public:
  /// @throws ConfigError for a world of more than 1e8 raster cells
  RandomStarts(const World& world, const Fleet& fleet);
  /// A pose for each robot, which depends only on the seed. @throws ConfigError when there is not enough space
  std::vector<mrpt::math::TPose2D> draw(std::uint64_t seed) const;

 private:
  std::string world_name_;
  std::size_t robots_;
  double radius_m_ = 0;
  std::vector<mrpt::math::TPoint2D> places_;
};

/// Moves the robots of a fleet, in its order. @param starts one for each robot
void setStartPoses(Fleet& fleet, std::span<const mrpt::math::TPose2D> starts);

/// Moves every robot of the fleet to a random start pose (RandomStarts).
void shuffleStartPoses(const World& world, Fleet& fleet, std::uint64_t seed);

}  // namespace robosim
