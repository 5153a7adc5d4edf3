#pragma once
#include "rendering/mesh.h"
#include "robots/robot_model.h"

namespace robosim {

/// Level of detail: all parts, the parts visible from afar, those of a robot a few pixels wide, or a block.
enum class Detail { full, rough, tiny, speck };

/// Mesh of a robot of a model: body, wheels, a heading mark and the visible sensors at their mounting poses. It stands
/// on z = 0 with its centre at x = y = 0, heading along x; painted parts take the instance's colour.
/// @param body the robot's, which may differ from its model's
Mesh robotMesh(const RobotModel& model, const Body& body, Detail detail);

}  // namespace robosim
