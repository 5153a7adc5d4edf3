#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "control/robot.h"

namespace robosim {

/// @name Motions of robots that push things, among obstacles
/// Obstacles are what the upper scanner (kHighLaser) detects; low objects are not avoided. Frame `map`: any in which
/// the robot knows its pose.
///@{

/// Drives in a direction of the robot's frame [rad], or in the nearest one without an obstacle in the next half metre;
/// turns on the spot first where that is far from its heading.
void driveTowards(Robot& robot, double bearing_rad, double speed_mps);

/// Drives to a place, and stops there. @return whether the robot is within `tolerance_m` of it
bool driveTo(Robot& robot, const mrpt::math::TPose2D& map_from_robot, const mrpt::math::TPoint2D& place,
             double speed_mps, double tolerance_m);

/// A round object that is to be pushed.
struct PushTask {
  mrpt::math::TPoint2D disc;    ///< its centre, map frame
  double radius_m = 0;          ///< of the object
  mrpt::math::TPoint2D target;  ///< where its centre is to go, map frame
};

/// Angle [rad] between the line from the robot to the disc and the one from the disc to the target, (-π, π]: 0 for a
/// robot that is directly behind the disc.
double pushError(const PushTask& task, const mrpt::math::TPose2D& map_from_robot);

/// Pushes a disc to a target: drives round to the far side of it in an arc, and then into it. Pushing is unstable,
/// since a disc rolls off a round robot; the robot therefore keeps the disc at the bearing at which the line through
/// both turns to the target.
void pushDisc(Robot& robot, const mrpt::math::TPose2D& map_from_robot, const PushTask& task, double speed_mps);

/// Drives to a disc with the gripper open, and closes it when the disc is between the paddles. In the next step,
/// Robot::held() is whether it holds the disc; if not, the gripper opens again.
/// @param disc its centre, map frame
void gripDisc(Robot& robot, const mrpt::math::TPose2D& map_from_robot, const mrpt::math::TPoint2D& disc,
              double radius_m, double speed_mps);
///@}

}  // namespace robosim
