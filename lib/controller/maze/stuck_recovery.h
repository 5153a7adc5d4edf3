#pragma once
#include <cstdint>

#include <mrpt/math/TPoint2D.h>

#include "control/controller.h"
#include "control/controller_type.h"

namespace robosim {

struct StuckRecoveryOptions {
  double timeout_s = 15;         ///< time in the disc after which the recovery starts
  double headway_radii = 1.5;    ///< radius of the disc, in robot radii
  double pocket_timeout_s = 90;  ///< time in the larger disc after which the robot follows the boundary
  double pocket_radii = 4;       ///< radius of the larger disc, in robot radii
};
inline constexpr StuckRecoveryOptions kUsualRecovery;

/// Recovery behaviour for a robot without progress, for example at the edge of the surface, at an undetected obstacle,
/// in a corner, or at another robot. A robot that has not left a disc in time (StuckRecoveryOptions) turns on the spot
/// by a random angle, drives slowly ahead while its lane is free, and repeats both until it has left the disc. A pocket
/// with a narrow exit allows such headway, so a robot that has not left a larger disc in time follows the boundary of
/// the pocket: it drives in arcs towards it, and turns away at contact, in one direction for a minute, then in the
/// other. Keeps no map and does not allocate. A robot without odometry makes progress in each step in which it drives
/// without a stall. The recovery restarts after a pause in the calls, in which the robot may have been driven
/// otherwise.
class StuckRecovery {
 public:
  /// @param options a constant, which must outlive it
  explicit StuckRecovery(const ControllerSetup& setup, const StuckRecoveryOptions& options = kUsualRecovery)
      : seed_(setup.seed), options_(&options), robot_(setup.robot) {}
  StuckRecovery(const ControllerSetup&, StuckRecoveryOptions&&) = delete;

  /// Commands the robot and returns true while the recovery is active. Call it in every step, before the controller's
  /// own decision.
  bool takesOver(Robot& robot);
  /// Whether the recovery has been active so far.
  bool hasDrawnRandomNumbers() const { return has_drawn_; }
  /// @name Of the setup, for a controller that keeps nothing else of it
  ///@{
  std::uint64_t seed() const { return seed_; }
  std::uint32_t robot() const { return robot_; }
  ///@}

 private:
  /// A place, and the step in which the robot last was farther from it than a disc's radius.
  struct Stay {
    mrpt::math::TPoint2D center;  ///< odometry frame
    std::uint32_t since = 0;      ///< step
  };
  bool hasLeft(const Stay& stay, double radii, const Robot& robot) const;
  void turnOrDrive(Robot& robot);
  void followBoundary(Robot& robot);

  // Small, because a run may have very many robots: only what it needs of the ControllerSetup, and steps of 32 bits,
  // which suffice for 13 years of tenths of a second.
  std::uint64_t seed_;
  const StuckRecoveryOptions* options_;
  Stay stay_, pocket_;
  double turn_ = 0;  ///< fraction of the robot's maximum turn rate, signed
  std::uint32_t robot_;
  std::uint32_t called_step_ = 0;                   ///< of the last call
  std::uint32_t turn_until_ = 0, drive_until_ = 0;  ///< steps
  bool is_in_pocket_ = false;
  bool is_active_ = false;
  bool has_drawn_ = false;
};

}  // namespace robosim
