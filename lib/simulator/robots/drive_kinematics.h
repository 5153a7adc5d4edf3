#pragma once
#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/path.h"
#include "hardware/command.h"
#include "hardware/drive.h"
#include "hardware/robot_info.h"
#include "robots/differential_drive.h"

namespace robosim {

/// What the speeds of differential_drive.h do not say about the motion of a robot with another drive.
struct DriveState {
  double lateral_mps = 0;   ///< speed to the left
  double steering_rad = 0;  ///< of a car: angle of its front wheels, counter-clockwise
  bool operator==(const DriveState&) const = default;
};

/// Speeds of a robot of any drive.
struct DriveMotion {
  DriveSpeeds speeds;
  DriveState state;
};

/// The motion reached within `period_s` towards a command's target speeds. Each speed has the limits of
/// reachableSpeeds(), and
///  * omni: the lateral speed has those of the speed, up to MotionLimits::lateral_max_mps;
///  * car: a command's turn rate by its speed is the curvature of its path, which the greatest steering angle limits.
///    A command without a speed leaves the wheels as they are: a car does not turn on the spot. Turn rate =
///    speed · tan(steering angle) / wheelbase, at most MotionLimits::turn_max_radps; the acceleration of turns has no
///    effect. Its origin moves as that of tracks;
///  * tracked: limits and acceleration of turns are those of the command, of which the robot turns Drive::turnShare().
///  Its
///    origin moves sideways while it turns, at -turn rate · icr_x_m.
DriveMotion reachableMotion(const Drive&, const DriveMotion& now, const Command& target, const MotionLimits&,
                            double period_s);

/// Path of one time step at these speeds. The turn of a car stops with its centre.
Path pathOf(const Drive&, const mrpt::math::TPose2D& world_from_robot, const DriveMotion&, double period_s);

/// What remains of the motion of a robot that was stopped by a contact.
DriveMotion stopped(const Drive&, const DriveMotion&);

/// The highest speed of a robot's origin over the ground [m/s].
double groundSpeedMax(const Drive&, const MotionLimits&);

}  // namespace robosim
