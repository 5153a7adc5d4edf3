#pragma once
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "control/robot.h"
#include "maze/maze_map.h"

namespace robosim {

/// Clearance [m] between a robot and the nearest echo of its range sensors in its lane, straight ahead (`direction` 1)
/// or straight back (-1); infinity without an echo.
double clearanceInLane(const Robot& robot, int direction);

/// Path follower over a MazeMap (pure pursuit): steers towards the farthest point ahead on the path that is reachable
/// in a straight line. The speed decreases with the heading error and with the distance to obstacles ahead.
class PathDriver {
 public:
  /// Sets a new path, from near the robot to its goal.
  void follow(const std::vector<Cell>& path);
  void clear() { path_.clear(); }
  bool empty() const { return path_.empty(); }
  const Cell& goal() const { return path_.back(); }

  /// Whether the path is blocked in the current map.
  bool blocked(const MazeMap& map) const;
  /// Commands the robot for the next step. @pre the path is not empty.
  void drive(Robot& robot, const mrpt::math::TPose2D& start_from_robot, const MazeMap& map);

 private:
  void advance(const MazeMap& map, const mrpt::math::TPoint2D& robot);
  Cell aim(const MazeMap& map, const Cell& robot) const;

  std::vector<Cell> path_;
  std::size_t next_ = 0;  ///< index of the path's cell that the robot has reached
};

}  // namespace robosim
