#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arcos/protocol/parameters.h"
#include "base/error_list.h"
#include "base/xml_element.h"
#include "hardware/robot_info.h"
#include "sensors/gripper.h"
#include "sensors/sensor.h"
#include "world/world.h"

namespace robosim {

/// Appearance of a robot to cameras and viewers; irrelevant to all other sensors.
enum class BodyLook {
  drum,  ///< an upright cylinder, like a Nomad Scout
  deck,  ///< a hull between two wheels with a flat deck, like a Pioneer; used for any box-shaped robot
};

/// Default of RobotModel::push_max_n: a third of the weight of a Pioneer 3-DX of 9 kg (data sheet), a coefficient that
/// rubber tyres reach on most floors.
constexpr double kPushMax_n = 30;

/// Model of a robot type: body, limits and mounted sensors. Robots of one type share one model.
struct RobotModel {
  /// Its name, such as "pioneer3dx", or "2005" for robots described in the world file itself; limits and drive.
  SharedValue<RobotTypeInfo> type;
  std::string help;  ///< one sentence; may be empty
  Body body;         ///< shape, height and colour; its pose is the robot's
  BodyLook look = BodyLook::drum;
  double radius_m = 0;             ///< of the disc used for move authorisation: Body::coveringRadius()
  double push_max_n = kPushMax_n;  ///< force with which it pushes objects; >= 0, 0: none moves
  std::vector<std::shared_ptr<const Sensor>> sensors;
  std::shared_ptr<const std::vector<SensorInfo>> sensor_infos;  ///< of `sensors`, with unique labels
  std::optional<GripperOptions> gripper;                        ///< of the one among `sensors`
  /// Hash of the elements that describe the sensors, and thus of all their options; 0 for a model not read from a file.
  std::uint64_t sensors_digest = 0;
  std::optional<arcos::Parameters> arcos;  ///< nullopt: ARCOS programs cannot drive robots of this type
};

/// Reads a robot type (worlds/robots/<name>.xml; doc/world_file.md). Adds faults to `errors`.
RobotModel readRobotModel(const std::filesystem::path& file, ErrorList& errors);

/// Description of a robot in a world file that overrides parts of its type.
struct RobotDescription {
  const Body* body = nullptr;                        ///< null: the type's
  const std::vector<XmlElement>* sensors = nullptr;  ///< null: the type's
  const XmlElement* drive = nullptr;                 ///< null: the type's
  std::string file;                                  ///< the world file, for error messages
  double unit_m = 1;                                 ///< of the world file
};

/// Makes the model of a robot type with the overrides of a world file. Adds faults of either file to `errors`.
RobotModel modelOf(const XmlElement& type, const std::string& type_file, const RobotDescription&, ErrorList& errors);

/// Makes the model of a robot that a 2005 world file describes completely. It moves like a Pioneer of its size: maximum
/// speed 2.5 radii per second, reached in one second; maximum turn rate 1.74 rad/s, reached in half a second.
/// @param description has a body and sensors
RobotModel modelOf2005(const RobotDescription& description, ErrorList& errors);

}  // namespace robosim
