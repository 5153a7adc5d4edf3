#pragma once
#include <cstdint>

#include "control/controller.h"
#include "maze/controllers.h"

namespace robosim {

struct StuckRecoveryOptions {
  double timeout_s = 15;       ///< time in the disc after which the recovery starts
  double headway_radii = 1.5;  ///< radius of the disc, in robot radii
};

/// Recovery behaviour for a robot without progress, for example at the edge of the surface, at an undetected obstacle,
/// in a corner, or at another robot. A robot that has not left a disc in time (StuckRecoveryOptions) turns on the spot
/// by a random angle, drives slowly ahead while its lane is free, and repeats both until it has left the disc. Keeps no
/// map and does not allocate. A robot without odometry makes progress in each step in which it drives without a stall.
/// The recovery restarts after a pause in the calls, in which the robot may have been driven otherwise.
class StuckRecovery {
 public:
  explicit StuckRecovery(const ControllerSetup& setup, const StuckRecoveryOptions& options = {})
      : setup_(setup), options_(options) {}

  /// Commands the robot and returns true while the recovery is active. Call it in every step, before the controller's
  /// own decision.
  bool takesOver(Robot& robot);
  /// Whether the recovery has been active so far.
  bool hasDrawnRandomNumbers() const { return has_drawn_; }

 private:
  bool hasMoved(const Robot& robot) const;
  void turnOrDrive(Robot& robot);

  ControllerSetup setup_;
  StuckRecoveryOptions options_;
  mrpt::math::TPose2D left_from_;  ///< centre of the disc, odometry frame
  std::uint64_t left_step_ = 0;    ///< when the robot last left such a disc
  std::uint64_t called_step_ = 0;  ///< of the last call
  bool is_active_ = false;
  bool has_drawn_ = false;
  std::uint64_t turn_until_ = 0, drive_until_ = 0;  ///< steps
  double turn_ = 0;                                 ///< fraction of the robot's maximum turn rate, signed
};

}  // namespace robosim
