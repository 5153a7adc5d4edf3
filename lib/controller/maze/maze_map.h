#pragma once
#include <cstdint>

#include "maze/grid.h"

namespace robosim {

/// Map cell of one robot. Frame: `start` of its PoseTracker.
struct MapCell {
  std::uint8_t evidence = 0;     ///< for an obstacle (Obstacles)
  std::uint8_t walls_near = 0;   ///< occupied cells within the robot's radius
  std::uint8_t walls_close = 0;  ///< occupied cells within the preferred clearance
  bool searched : 1 = false;     ///< gold here, or slightly beyond, would have been detected (HeatTrace)
  bool stood : 1 = false;        ///< the robot was here, and the heat was below the threshold
  std::uint8_t bumps : 2 = 0;    ///< collisions here, up to 3 (Obstacles)
  float heat_weight = 0;         ///< sums over the places where heat was measured (HeatTrace)
  float heat_match = 0;

  /// Whether the robot's centre must not be here.
  bool blocked() const { return walls_near > 0; }
};

using MazeMap = Grid<MapCell>;

}  // namespace robosim
