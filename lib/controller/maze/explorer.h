#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.h"
#include "control/controller_type.h"
#include "control/robot.h"
#include "maze/heat_trace.h"
#include "maze/maze_map.h"
#include "maze/obstacles.h"
#include "maze/path_driver.h"
#include "maze/pose_tracker.h"
#include "maze/scan_matcher.h"
#include "maze/sonar_regions.h"
#include "maze/stuck_recovery.h"
#include "maze/wavefront.h"

namespace robosim {

/// A map with the searches that work on it; copies work on their own map.
struct SearchMap {
  SearchMap(double cell_m, double heat_range_m, double robot_radius_m)
      : map(cell_m), obstacles(map, robot_radius_m), heat(map, heat_range_m, robot_radius_m) {}
  SearchMap(const SearchMap& other)
      : map(other.map), obstacles(other.obstacles.copyOn(map)), heat(other.heat.copyOn(map)) {}
  SearchMap& operator=(const SearchMap&) = delete;

  MazeMap map;
  Obstacles obstacles;
  HeatTrace heat;
};

/// Additional costs of places to search, with which robots of a team avoid each other.
class GoalCost {
 public:
  virtual ~GoalCost() = default;
  /// >= 0, in the unit of Wavefront::kStraight.
  virtual int computeCost(const Cell&) const = 0;
};

/// Explores an unknown environment until all reachable cells have been searched for heat, and approaches heat sources.
/// The map is in the frame `start` of its PoseTracker. States:
///  - explore: drive to the nearest cell not searched for heat, through cells not known to be blocked;
///  - follow: above the heat threshold, drive to the nearest unvisited cell around the estimated source;
///  - blocked: reverse, and turn by a random angle, which resolves deadlocks between robots;
///  - all searched: remove uncertain obstacles, wait briefly for robots in the way, then start a new map.
class Explorer {
 public:
  /// @param warm heat above which a source is followed; must exceed the sensor's noise.
  /// @param map_from_start the robot's first pose in the frame of the map
  /// @throws std::invalid_argument for a robot without odometry or without heat sensor.
  Explorer(const Robot& robot, const ControllerSetup& setup, double warm,
           const mrpt::math::TPose2D& map_from_start = {});

  /// Updates the map, plans and commands the robot; called once per time step.
  /// @param goal_cost added to the costs of places to search; null for none
  void step(Robot& robot, const GoalCost* goal_cost = nullptr);

  const MazeMap& map() const { return search_.map; }
  /// Pose of the robot in the frame of the map.
  const mrpt::math::TPose2D& pose() const { return tracker_.startFromRobot(); }
  /// For entries that other robots have measured.
  SearchMap& search() { return search_; }
  /// The place to search to which it drives; nullopt while there is none, and while it follows heat.
  std::optional<Cell> searchGoal() const {
    return following_ || driver_.empty() ? std::nullopt : std::optional(driver_.goal());
  }
  /// Drops the path to the present goal; the next step plans another one.
  void dropGoal() { driver_.clear(); }
  /// Number of times that the map was completed and restarted.
  int rounds() const { return rounds_; }
  /// Whether it has reversed by a random amount so far.
  bool hasDrawnRandomNumbers() const { return has_drawn_ || recovery_.hasDrawnRandomNumbers(); }

 private:
  void track(const Robot& robot);
  void look(const Robot& robot);
  void correctPose(const Robot& robot);
  void feel(const Robot& robot);
  bool needsPlan();
  void plan(const Robot& robot, const GoalCost* goal_cost);
  bool planToHeat(const Cell& start);
  bool planToSearch(const Cell& start, const GoalCost* goal_cost);
  /// Plans the path to the goal of least cost (Wavefront::findGoal); false when there is none.
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
  StuckRecovery recovery_;  ///< used when reversing does not help
  bool has_noise_;          ///< of range sensors
  PoseTracker tracker_;
  ScanMatcher matcher_;  ///< used if range sensors are noisy
  SonarRegions sonars_;  ///< of noisy sonars
  std::vector<SurfacePoint> surfaces_;
  SearchMap search_;
  Wavefront wavefront_;
  PathDriver driver_;
  std::vector<Cell> path_;
  int rounds_ = 0;

  // Times are step numbers.
  mrpt::math::TPose2D looked_from_;
  std::uint64_t look_at_ = 0;  ///< latest next map update

  std::uint64_t plan_from_ = 0;     ///< earliest next plan
  std::uint64_t seen_changes_ = 0;  ///< Obstacles::changes() at the last check of the path
  std::optional<std::uint64_t> nothing_left_since_;

  bool following_ = false;  ///< heat; otherwise exploring
  bool source_moved_ = false;
  std::uint64_t follow_until_ = 0, explore_until_ = 0;

  mrpt::math::TPose2D moved_from_;  ///< pose of the last progress
  std::uint64_t moved_at_ = 0;
  int stalled_steps_ = 0;
  std::uint64_t back_until_ = 0;  ///< end of reversing
  double back_speed_ = 0, back_turn_ = 0;
  bool has_drawn_ = false;
};

}  // namespace robosim
