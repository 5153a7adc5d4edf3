#pragma once
#include "base/xml_reader.h"
#include "hardware/drive.h"
#include "hardware/robot_info.h"

namespace robosim {

/// Reads <drive type="…"> of a robot type or of a robot in a world file (doc/robot_type.md#drives).
/// @param limits of the robot; their lateral_max_mps is set
Drive readDrive(XmlReader&, MotionLimits& limits);

}  // namespace robosim
