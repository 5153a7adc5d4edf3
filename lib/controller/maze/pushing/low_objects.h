#pragma once
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "control/robot.h"

namespace robosim {

/// Labels of the laser scanners of a robot that detects low objects, such as the type `pusher`.
inline constexpr const char* kLowLaser = "laser_low";
inline constexpr const char* kHighLaser = "laser_high";

/// Centres of the low round objects in view, in the robot's frame [m], the nearest first: of what the lower scanner
/// detects nearer than the upper one, which has equal beams. Walls and other robots are as near for both. Several
/// objects in contact are distinguished by their radius. Empty for a robot without these scanners.
/// @param radius_m of the objects, > 0
std::vector<mrpt::math::TPoint2D> lowObjects(const Robot& robot, double radius_m);

}  // namespace robosim
