#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error_list.h"
#include "hardware/robot_info.h"
#include "sensors/sensor.h"
#include "world/world.h"

namespace robosim {

/// A type of robot: body, limits and mounted sensors. Robots of one type share one model.
struct RobotModel {
  std::string name;   ///< "pioneer3dx"; "2005" for robots that a world file describes itself
  Body body;          ///< shape, height and look; its pose is the robot's
  double radius_m = 0;  ///< of the disc that authorising moves takes it for: Body::coveringRadius()
  MotionLimits limits;
  std::vector<std::shared_ptr<const Sensor>> sensors;
  std::shared_ptr<const std::vector<SensorInfo>> sensor_infos;  ///< of `sensors`, with labels that are unique
};

/// Reads a robot type (worlds/robots/<name>.xml; doc/world_file.md). Adds faults to `errors`.
RobotModel readRobotModel(const std::filesystem::path& file, ErrorList& errors);

}  // namespace robosim
