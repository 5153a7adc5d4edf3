#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/solid.h"
#include "world/world.h"

namespace robosim {

/// An event of a run at a place.
struct RunEvent {
  enum class Kind { gold, message, stall };  ///< found gold; sent a message; was stopped by an obstacle
  Kind kind;
  std::size_t robot;
  mrpt::math::TPoint2D at;  ///< of the robot, world frame
};

/// Content of a plan or figure. Vectors by robot are in the world's order, or empty.
struct DrawnRun {
  std::string title{};                                     ///< empty: the world's name
  std::vector<std::vector<mrpt::math::TPoint2D>> paths{};  ///< of each robot's centre, world frame; may be empty
  /// Final poses; a robot without one is not drawn.
  std::vector<std::optional<mrpt::math::TPose2D>> world_from_robot{};
  std::vector<RunEvent> events{};
};

/// The area that a picture of a run covers: the world's bounds, every object, map and path.
Bounds2D areaOf(const World&, const DrawnRun&);

}  // namespace robosim
