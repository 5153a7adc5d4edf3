#pragma once
#include <cstdint>

#include "maze/grid.h"

namespace robosim {

/// What a robot has learnt of one place. Frame: `start`, that of its PoseTracker.
struct MapCell {
  std::uint8_t evidence = 0;     ///< that something stands here (Obstacles)
  std::uint8_t walls_near = 0;   ///< cells with something in them so near that the robot would touch it
  std::uint8_t walls_close = 0;  ///< the same for a berth that it had better keep
  bool searched : 1 = false;     ///< gold here, or a little beyond, would have been felt (HeatTrace)
  bool stood : 1 = false;        ///< the robot was here, and it was not hot enough
  float heat_weight = 0;         ///< sums over the places where heat was measured (HeatTrace)
  float heat_match = 0;

  /// Whether the robot's centre must not be here.
  bool blocked() const { return walls_near > 0; }
};

using MazeMap = Grid<MapCell>;

}  // namespace robosim
