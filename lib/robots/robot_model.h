#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error_list.h"
#include "base/xml_element.h"
#include "hardware/robot_info.h"
#include "sensors/sensor.h"
#include "world/world.h"

namespace robosim {

/// What a robot looks like to cameras and viewers. No sensor but a camera sees a difference.
enum class BodyLook {
  drum,  ///< an upright drum, like a Nomad Scout
  deck,  ///< a hull between two wheels with a flat deck, like a Pioneer; any box-shaped robot has this look
};

/// A type of robot: body, limits and mounted sensors. Robots of one type share one model.
struct RobotModel {
  std::string name;  ///< "pioneer3dx"; "2005" for robots that a world file describes itself
  std::string help;  ///< one sentence; may be empty
  Body body;         ///< shape, height and colour; its pose is the robot's
  BodyLook look = BodyLook::drum;
  double radius_m = 0;  ///< of the disc that authorising moves takes it for: Body::coveringRadius()
  MotionLimits limits;
  std::vector<std::shared_ptr<const Sensor>> sensors;
  std::shared_ptr<const std::vector<SensorInfo>> sensor_infos;  ///< of `sensors`, with labels that are unique
};

/// Reads a robot type (worlds/robots/<name>.xml; doc/world_file.md). Adds faults to `errors`.
RobotModel readRobotModel(const std::filesystem::path& file, ErrorList& errors);

/// What a world file says of a robot, in place of what its type says.
struct RobotDescription {
  const Body* body = nullptr;                        ///< null: the type's
  const std::vector<XmlElement>* sensors = nullptr;  ///< null: the type's
  std::string file;                                  ///< the world file, for error messages
  double unit_m = 1;                                 ///< of the world file
};

/// The model of a type's robot, of which a world file describes parts anew. Faults of either go to `errors`.
RobotModel modelOf(const XmlElement& type, const std::string& type_file, const RobotDescription&, ErrorList& errors);

/// The model of a robot that a 2005 world file describes alone. It moves like a Pioneer of its size: top speed 2.5
/// radii a second, reached in one second; turns at 1.74 rad/s, reached in half a second.
/// @param description has a body and sensors.
RobotModel modelOf2005(const RobotDescription& description, ErrorList& errors);

}  // namespace robosim
