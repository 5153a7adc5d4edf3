#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"
#include "maze/maze_map.h"

namespace robosim {

/// Where something stands, learnt from echoes: evidence for it in the cell of each echo, evidence against it along the
/// way there. So a wall stays, and a robot that passed by fades as soon as the place is seen empty. Places never seen
/// count as free.
class Obstacles {
 public:
  /// @param map must outlive this, and be changed by nothing else.
  Obstacles(MazeMap& map, double robot_radius_m);

  /// Takes in what a range sensor heard from `start_from_robot`; only every `stride`-th beam.
  void look(const mrpt::math::TPose2D& start_from_robot, const SensorInfo& sensor, const Echoes& echoes,
            std::size_t stride = 1);
  /// Nothing stands where the robot itself is.
  void clearUnder(const mrpt::math::TPoint2D& robot);
  /// The robot ran into something here that no sensor told of.
  void bump(const mrpt::math::TPoint2D& place);

  /// Drops what was not seen again and again.
  void forgetDoubtful();
  /// Goes up whenever a cell becomes occupied or free.
  std::uint64_t changes() const { return changes_; }

  /// How many cells about the robot the map must have before look().
  int reach() const;

 private:
  void add(const Cell& cell, int evidence);
  void seeFree(const Cell& cell);
  void occupy(const Cell& cell, int by);

  MazeMap& map_;
  double radius_m_;
  std::vector<Cell> near_, close_;  ///< offsets within reach of the body, and of its berth
  std::uint64_t changes_ = 0;
};

}  // namespace robosim
