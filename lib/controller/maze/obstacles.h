#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"
#include "maze/maze_map.h"

namespace robosim {

/// Occupancy grid from range echoes: the cell of each echo gains evidence, and the cells along its ray lose evidence.
/// Walls persist, and moving robots fade once their cells are observed empty. Unobserved cells count as free.
class Obstacles {
 public:
  /// @param map must outlive this, and must not be changed elsewhere.
  Obstacles(MazeMap& map, double robot_radius_m);

  /// A copy that works on `map`, a copy of its map.
  Obstacles copyOn(MazeMap& map) const {
    Obstacles copy = *this;
    copy.map_ = &map;
    return copy;
  }

  /// Adds the echoes of a range sensor at `start_from_robot`; only every `stride`-th beam.
  void look(const mrpt::math::TPose2D& start_from_robot, const SensorInfo& sensor, const Echoes& echoes,
            std::size_t stride = 1);
  /// Adds one line of sight in the frame `start`, with an echo at its end or without. An echo that is not sure requires
  /// others at the same place.
  void trace(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, bool is_echo, bool is_sure = true);
  /// Marks the cells of the robot's own body as free.
  void clearUnder(const mrpt::math::TPoint2D& robot);
  /// Marks an obstacle that was detected by collision only. After three collisions in a cell, as with an obstacle that
  /// is too low for the range sensors, measurements of free space no longer remove it.
  void bump(const mrpt::math::TPoint2D& place);

  /// Marks an obstacle that was not detected by this robot, with at least this evidence; covers its cell. Evidence of
  /// kLearned is removed by few observations of free space, and by removeUncertain().
  void learn(const Cell& cell, int evidence);
  static constexpr int kLearned = 3, kCertain = 12;  ///< the least and the greatest evidence of an obstacle

  /// Removes obstacles without repeated evidence from range sensors.
  void removeUncertain();
  /// Counter of cells that became occupied or free.
  std::uint64_t changes() const { return changes_; }

  /// Radius around the robot that the map must cover before look() [cells].
  int reach() const;

 private:
  void add(const Cell& cell, int evidence);
  void seeFree(const Cell& cell);
  void clear(const Cell& cell);
  void occupy(const Cell& cell, int by);

  MazeMap* map_;
  double radius_m_;
  std::vector<Cell> near_, close_;  ///< offsets within the body's radius, and within its clearance
  std::uint64_t changes_ = 0;
};

}  // namespace robosim
