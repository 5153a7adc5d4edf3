#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/maze_map.h"
#include "maze/obstacles.h"
#include "maze/path_driver.h"
#include "maze/pose_tracker.h"
#include "maze/stuck_recovery.h"
#include "maze/wavefront.h"

namespace robosim {

/// Drives the shortest path on the known map to the nearest place at which the heat of gold exceeds the threshold, at
/// the speeds of a PathDriver: the reference for the times of searches. It adds other robots that it detects to its map
/// and drives round them; StuckRecovery handles lack of progress. Without a known map it stands still.
class Oracle : public Controller {
 public:
  Oracle(const ControllerSetup& setup, double heat_threshold)
      : setup_(setup),
        heat_threshold_(heat_threshold),
        tracker_(setup.world_from_start.value_or(mrpt::math::TPose2D())),
        recovery_(setup, kRecovery) {}
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Oracle>(*this); }
  bool hasDrawnRandomNumbers() const override { return recovery_.hasDrawnRandomNumbers(); }

  /// Cells of the path at present, from the robot to its goal; world frame.
  const std::vector<Cell>& path() const { return path_; }

 private:
  static constexpr StuckRecoveryOptions kRecovery{.timeout_s = 4, .headway_radii = 0.5};

  /// A map with the obstacles that work on it; copies work on their own map.
  struct Plan {
    Plan(double cell_m, double radius_m) : map(cell_m), obstacles(map, radius_m) {}
    Plan(const Plan& other) : map(other.map), obstacles(other.obstacles.copyOn(map)) {}
    Plan& operator=(const Plan&) = delete;

    MazeMap map;
    Obstacles obstacles;
  };

  void readMap(const Robot& robot);
  void look(const Robot& robot);
  void findPath(const Robot& robot);

  ControllerSetup setup_;
  double heat_threshold_;
  PoseTracker tracker_;
  StuckRecovery recovery_;
  std::optional<Plan> plan_;  ///< constructed in the first step, since it requires the robot
  Wavefront wavefront_;
  PathDriver driver_;
  std::vector<Cell> path_;
  double nearer_ = 1;  ///< fraction of the distance at which the heat should exceed the threshold
  std::uint64_t plan_from_ = 0;
};

}  // namespace robosim
