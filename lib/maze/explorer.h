#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.h"
#include "control/robot.h"
#include "maze/controllers.h"
#include "maze/heat_trace.h"
#include "maze/maze_map.h"
#include "maze/obstacles.h"
#include "maze/path_driver.h"
#include "maze/pose_tracker.h"
#include "maze/wavefront.h"

namespace robosim {

/// Drives a robot through a place that it has not seen until it has felt for heat everywhere it can reach, and towards
/// heat wherever it feels some. It draws its map in the frame `start` of its PoseTracker:
///  - explore: to the nearest place not yet searched for heat, through whatever is not known to be blocked;
///  - follow: where it is warm, to the nearest place about the likely source where it has not stood;
///  - when it does not get on: draws back, and turns by chance, so that two who block each other part;
///  - when nothing is left to search: drops obstacles that were not sure, waits a little for whoever stands in the way,
///    and then begins a new map.
class Explorer {
 public:
  /// @param warm heat from which on it is worth following, above the sensor's noise.
  /// @throws std::invalid_argument for a robot without odometry or without heat sensor.
  Explorer(const Robot& robot, const ControllerSetup& setup, double warm);
  Explorer(const Explorer&) = delete;
  Explorer& operator=(const Explorer&) = delete;

  /// Looks, decides and commands; once a time step.
  void step(Robot& robot);

  const MazeMap& map() const { return map_; }
  /// How often everything was searched and the map begun anew.
  int rounds() const { return rounds_; }

 private:
  void look(const Robot& robot);
  void feel(const Robot& robot);
  bool needsPlan();
  void plan(const Robot& robot);
  bool planToHeat(const Cell& start);
  bool planToSearch(const Cell& start);
  /// Takes the way to the goal that `judge` likes best (Wavefront::findGoal); false when there is none.
  template <typename Judge>
  bool planTo(const Cell& start, int cost_max, const Judge& judge);
  bool isSliver(const Cell& cell) const;
  bool atGoal() const;
  void startOver();
  bool isStuck(const Robot& robot);
  void drawBack(Robot& robot);
  mrpt::math::TPoint2D place() const { return {tracker_.startFromRobot().x, tracker_.startFromRobot().y}; }

  double warm_;
  Rng rng_;
  PoseTracker tracker_;
  MazeMap map_;
  Obstacles obstacles_;
  HeatTrace heat_;
  Wavefront wavefront_;
  PathDriver driver_;
  std::vector<Cell> way_;
  int rounds_ = 0;

  // Moments are numbers of time steps.
  mrpt::math::TPose2D looked_from_;
  std::uint64_t look_at_ = 0;  ///< it looks again, at the latest

  std::uint64_t plan_from_ = 0;     ///< earliest next plan
  std::uint64_t seen_changes_ = 0;  ///< Obstacles::changes() at the last look at the way
  std::optional<std::uint64_t> nothing_left_since_;

  bool following_ = false;  ///< heat, rather than exploring
  bool source_moved_ = false;
  std::uint64_t follow_until_ = 0, explore_until_ = 0;

  mrpt::math::TPose2D moved_from_;  ///< where it last got on
  std::uint64_t moved_at_ = 0;
  std::uint64_t back_until_ = 0;  ///< it draws back
  double back_speed_ = 0, back_turn_ = 0;
};

}  // namespace robosim
