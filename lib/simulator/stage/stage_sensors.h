#pragma once
#include "base/xml_element.h"
#include "stage/stage_reader.h"

namespace robosim::stage {

/// A device on a robot.
struct SensorMount {
  const PropertyReader* reader = nullptr;
  Pose robot_from_device;  ///< of its underside
  Size size;
  Notes* notes = nullptr;
  std::size_t robots = 0;  ///< in the world
  double robot_height_m = 0;
  double highest_m = 0;  ///< output: height of the highest sensor of the device
};

/// Translates a device into sensors of a robot type: ranger, laser, sonar, blobfinder, camera, fiducial, gripper,
/// bumper.
/// @param sensors receives the elements
/// @return false for a device of another kind
bool addSensor(SensorMount& mount, XmlElement& sensors);

}  // namespace robosim::stage
