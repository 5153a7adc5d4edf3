#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/pose_tracker.h"

namespace robosim {

struct ForagerOptions {
  mrpt::math::TPoint2D nest{0, 0};  ///< its centre, world frame [m]
  double nest_radius_m = 1.2;
  double puck_radius_m = 0.1;
  double speed_mps = 0.5;
};

/// Brings low round objects into a nest (central-place foraging): drives at random until its scanners detect one
/// outside the nest, pushes it in, backs off, and continues. A robot with a gripper carries it there instead. It knows
/// its start pose in the world and the nest's place, and from there its own odometry and compass. Robots do not
/// communicate.
class Forager : public Controller {
 public:
  Forager(const ControllerSetup& setup, const ForagerOptions& options);
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Forager>(*this); }
  bool hasDrawnRandomNumbers() const override { return true; }

 private:
  /// A puck that the robot could not move, and the step until which it leaves it.
  struct Ignored {
    mrpt::math::TPoint2D place;
    std::uint64_t until = 0;
  };
  /// Pucks in view outside the nest, world frame.
  std::vector<mrpt::math::TPoint2D> pucksOutside(const Robot& robot, const mrpt::math::TPose2D& world_from_robot) const;
  /// Follows the puck that it pushes, or selects one; whether it has one.
  bool selectPuck(const Robot& robot, const mrpt::math::TPose2D& world_from_robot);
  /// Grips the puck, carries it into the nest, and drops it there.
  void carry(Robot& robot, const mrpt::math::TPose2D& world_from_robot);
  void search(Robot& robot, const mrpt::math::TPose2D& world_from_robot);
  void backOff(Robot& robot);
  double nestDistance(const mrpt::math::TPoint2D& place) const;

  ControllerSetup setup_;
  ForagerOptions options_;
  PoseTracker tracker_;
  std::optional<mrpt::math::TPoint2D> puck_;  ///< world frame
  std::uint64_t seen_step_ = 0;               ///< when the puck was last in view
  double nearest_m_ = 0;                      ///< smallest distance of the puck from the nest so far
  std::uint64_t progress_step_ = 0;           ///< when that was reached
  std::vector<Ignored> ignored_;
  std::uint64_t back_until_ = 0;    ///< step until which it drives back
  std::uint64_t course_until_ = 0;  ///< step until which it keeps its course while it searches
  double course_rad_ = 0;           ///< world frame
};

}  // namespace robosim
