#include "maze/stuck_recovery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "maze/path_driver.h"

namespace robosim {
namespace {

constexpr double kTurn = 0.6;                          // fraction of the maximum turn rate
constexpr double kTurnMin_rad = std::numbers::pi / 6;  // a turn on the spot
constexpr double kTurnMax_rad = std::numbers::pi;      // in both directions: covers all headings
constexpr double kDriveMin_s = 1;
constexpr double kDriveMax_s = 6;
constexpr double kSpeed = 0.2;                         // fraction of the maximum speed
constexpr double kRound_s = 60;                        // along a pocket's boundary in one direction
constexpr double kAwayMin_rad = std::numbers::pi / 9;  // a turn away from a contact
constexpr double kAwayMax_rad = std::numbers::pi / 3;
constexpr double kArc_radii = 2;  // radius of the arcs back to the boundary, in robot radii
constexpr double kGap_m = 0.02;
constexpr std::uint64_t kPauseSteps = 10;
constexpr std::uint32_t kRandomItem = 1;  // random stream separate from the controller's

/// Steps of a turn or drive; half of all steps for one that takes longer.
std::uint32_t stepsIn(double seconds, const Robot& robot) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(robot.stepsIn(seconds), 1u << 31));
}

}  // namespace

bool StuckRecovery::takesOver(Robot& robot) {
  const auto now = static_cast<std::uint32_t>(robot.stepNumber());
  const bool was_paused = now > called_step_ + kPauseSteps;
  called_step_ = now;
  if (was_paused || hasLeft(stay_, options_->headway_radii, robot)) {
    const auto& pose = robot.odometry().odom_from_robot;
    const Stay here{{pose.x, pose.y}, now};
    if (was_paused || hasLeft(pocket_, options_->pocket_radii, robot)) pocket_ = here;
    stay_ = here;
    is_in_pocket_ = now >= pocket_.since + robot.stepsIn(options_->pocket_timeout_s);
    if (!is_in_pocket_) {
      is_active_ = false;
      return false;
    }
  }
  if (!is_active_) {
    if (!is_in_pocket_ && now < stay_.since + robot.stepsIn(options_->timeout_s)) return false;
    is_active_ = true;
    has_drawn_ = true;
    turn_until_ = drive_until_ = now;
  }
  if (is_in_pocket_) {
    followBoundary(robot);
  } else {
    turnOrDrive(robot);
  }
  return true;
}

bool StuckRecovery::hasLeft(const Stay& stay, double radii, const Robot& robot) const {
  if (!robot.sensor(SensorKind::odometry)) return !robot.stalled() && robot.command().speed_mps != 0;
  const auto& now = robot.odometry().odom_from_robot;
  const double x = now.x - stay.center.x, y = now.y - stay.center.y;
  const double disc_m = radii * robot.info().radius_m;
  return x * x + y * y > disc_m * disc_m;
}

void StuckRecovery::turnOrDrive(Robot& robot) {
  const MotionLimits& limits = robot.info().type->limits;
  const auto now = static_cast<std::uint32_t>(robot.stepNumber());
  const bool is_blocked = robot.stalled() || clearanceInLane(robot, 1) < kGap_m;
  if (now >= turn_until_ && (is_blocked || now >= drive_until_)) {
    Rng rng(seed_, RandomPurpose::controller, robot_, kRandomItem, now);
    turn_ = rng.below(2) == 0 ? kTurn : -kTurn;
    const double angle_rad = rng.uniform(kTurnMin_rad, kTurnMax_rad);
    turn_until_ = now + stepsIn(angle_rad / (kTurn * limits.turn_max_radps), robot);
    drive_until_ = turn_until_ + stepsIn(rng.uniform(kDriveMin_s, kDriveMax_s), robot);
  }
  const bool turns = now < turn_until_;
  robot.drive(turns ? 0 : kSpeed * limits.speed_max_mps, turns ? turn_ * limits.turn_max_radps : 0);
}

void StuckRecovery::followBoundary(Robot& robot) {
  const MotionLimits& limits = robot.info().type->limits;
  const auto now = static_cast<std::uint32_t>(robot.stepNumber());
  const std::uint64_t rounds = (now - pocket_.since) / robot.stepsIn(kRound_s);
  const double side = rounds % 2 == 0 ? 1 : -1;
  if (now >= turn_until_ && (robot.stalled() || clearanceInLane(robot, 1) < kGap_m)) {
    Rng rng(seed_, RandomPurpose::controller, robot_, kRandomItem, now);
    const double angle_rad = rng.uniform(kAwayMin_rad, kAwayMax_rad);
    turn_until_ = now + stepsIn(angle_rad / (kTurn * limits.turn_max_radps), robot);
  }
  const double speed_mps = kSpeed * limits.speed_max_mps;
  if (now < turn_until_) {
    robot.drive(0, side * kTurn * limits.turn_max_radps);
  } else {
    const double arc_radps = speed_mps / (kArc_radii * robot.info().radius_m);
    robot.drive(speed_mps, -side * std::min(arc_radps, limits.turn_max_radps));
  }
}

}  // namespace robosim
