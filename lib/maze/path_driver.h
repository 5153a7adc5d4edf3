#pragma once
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "control/robot.h"
#include "maze/maze_map.h"

namespace robosim {

/// Room [m] that a robot has before it touches what its range sensors hear, straight ahead (`direction` 1) or straight
/// back (-1); infinity when nothing is there.
double roomInLane(const Robot& robot, int direction);

/// Drives a robot along a way over a MazeMap: towards a point some way ahead on it that can be reached in a straight
/// line (pure pursuit), the slower the more it has to turn and the nearer something is in front.
class PathDriver {
 public:
  /// Takes a new way, from near the robot to its goal.
  void follow(const std::vector<Cell>& way);
  void clear() { way_.clear(); }
  bool empty() const { return way_.empty(); }
  const Cell& goal() const { return way_.back(); }

  /// Whether something blocks the way, as the map knows by now.
  bool blocked(const MazeMap& map) const;
  /// Commands the robot for the next step. The way must not be empty.
  void drive(Robot& robot, const mrpt::math::TPose2D& start_from_robot, const MazeMap& map);

 private:
  void advance(const MazeMap& map, const mrpt::math::TPoint2D& robot);
  Cell aim(const MazeMap& map, const Cell& robot) const;

  std::vector<Cell> way_;
  std::size_t next_ = 0;  ///< the cell of the way that the robot has come to
};

}  // namespace robosim
