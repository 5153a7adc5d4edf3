#include "sensors/sensor.h"

#include <cmath>

namespace robosim {

RobotFrame::RobotFrame(const mrpt::math::TPose2D& world_from_robot, double base_z_m)
    : x_(world_from_robot.x),
      y_(world_from_robot.y),
      z_(base_z_m),
      cos_(std::cos(world_from_robot.phi)),
      sin_(std::sin(world_from_robot.phi)) {}

}  // namespace robosim
