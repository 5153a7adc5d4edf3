#pragma once
#include "rendering/mesh.h"
#include "robots/robot_model.h"

namespace robosim {

/// How much of a robot is drawn: all of it, what is seen of it from afar, or what a few pixels show.
enum class Detail { full, rough, tiny };

/// What robots of a model look like: body, wheels, a mark in front, and the sensors that one can see, each where it is
/// mounted. Stands on z = 0 with its centre at x = y = 0, looking along x; its paint is the robot's own colour.
/// @param body the robot's, which may be another than its model's
Mesh robotMesh(const RobotModel& model, const Body& body, Detail detail);

}  // namespace robosim
