#include "maze/pushing/doorway.h"

#include <algorithm>
#include <cmath>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kDoorPlace_m = 0.05;
constexpr const char* kOpen = "OPEN";
constexpr const char* kPassed = "PASSED";

TPoint2D startPlaceOf(const ControllerSetup& setup) {
  const TPose2D start = setup.world_from_start.value_or(TPose2D());
  return {start.x, start.y};
}

/// Drives straight to a place, ahead or back, whichever needs the smaller turn. @return whether it is there
bool driveStraight(Robot& robot, const TPose2D& world_from_robot, const TPoint2D& place, double speed_mps) {
  const TPoint2D way(place.x - world_from_robot.x, place.y - world_from_robot.y);
  const double distance_m = portable::hypot(way.x, way.y);
  if (distance_m < kDoorPlace_m) {
    robot.stop();
    return true;
  }
  double turn_rad = mrpt::math::wrapToPi(portable::atan2(way.y, way.x) - world_from_robot.phi);
  double direction = 1;
  if (std::abs(turn_rad) > M_PI_2) {
    turn_rad = mrpt::math::wrapToPi(turn_rad + M_PI);
    direction = -1;
  }
  const double braking_mps = std::sqrt(robot.info().type->limits.decel_mps2 * distance_m);
  const double share = std::max(0.0, 1 - 2 * std::abs(turn_rad));
  robot.drive(direction * share * std::min(speed_mps, braking_mps), 3 * turn_rad);
  return false;
}

}  // namespace

Doorway::Doorway(const ControllerSetup& setup, const DoorwayOptions& options)
    : options_(options), start_(startPlaceOf(setup)), tracker_(setup.world_from_start.value_or(TPose2D())) {}

void Doorway::step(Robot& robot) {
  tracker_.update(robot);
  for (const RobotMessage& message : robot.inbox()) {
    has_heard_ = has_heard_ || message.text == (options_.is_holder ? kPassed : kOpen);
  }
  if (options_.is_holder) {
    hold(robot);
  } else {
    pass(robot);
  }
}

void Doorway::hold(Robot& robot) {
  if (has_heard_) {
    if (driveStraight(robot, tracker_.startFromRobot(), start_, options_.speed_mps)) robot.halt();
    return;
  }
  if (driveStraight(robot, tracker_.startFromRobot(), options_.place, options_.speed_mps)) robot.broadcast(kOpen);
}

void Doorway::pass(Robot& robot) {
  if (!has_heard_) {
    robot.stop();
    return;
  }
  if (!driveStraight(robot, tracker_.startFromRobot(), options_.place, options_.speed_mps)) return;
  robot.broadcast(kPassed);
  robot.halt();
}

}  // namespace robosim
