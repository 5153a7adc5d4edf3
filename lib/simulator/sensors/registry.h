#pragma once
#include <memory>
#include <span>

#include "base/xml_reader.h"
#include "hardware/drive.h"
#include "sensors/sensor.h"

namespace robosim {

/// Maximum number of rays and sectors of one robot's sensors. A sonar of the model `rays` counts every ray of its
/// bundle.
constexpr std::size_t kRobotRaysMax = 100'000;
/// Maximum number of pixels of a robot's ray-cast cameras.
constexpr std::size_t kRobotPixelsMax = 4 * kRawPixelsMax;

/// Properties of the robot that carries a sensor, for the sensor's reader.
struct Mount {
  double unit_m = 1;  ///< length unit of the file [m]; used by 2005 <sensor> elements only
  double robot_radius_m = 0;
  double robot_height_m = 0;
  std::span<const std::shared_ptr<const Sensor>> mounted = {};  ///< sensors mounted before, by slot
  std::size_t mounted_rays = 0;                                 ///< sum of their Sensor::rayCount()
  Drive drive = {};
};

/// A kind of sensor and the readers of its elements.
struct SensorType {
  const char* name;  ///< the element's tag in a robot type: <sonar …/>; <type> in a 2005 <sensor>
  const char* help;  ///< one sentence
  bool has_noise;    ///< whether its element may have a <noise> child
  std::unique_ptr<Sensor> (*read)(XmlReader&, const Mount&);
  /// Reads a 2005 <sensor>; null for kinds that 2005 did not have.
  std::unique_ptr<Sensor> (*read_2005)(XmlReader&, const Mount&);
};

/// All kinds of sensors; valid until addSensorTypes() is called.
std::span<const SensorType> sensorTypes();
/// Adds kinds of sensors from outside RoboSim, before the first world is read. Their texts must stay valid.
/// @throws ConfigError for an invalid or known name, and a type without help or read(); none is then added
void addSensorTypes(std::span<const SensorType> types);
/// The kind of a name; null for an unknown one.
const SensorType* sensorType(const std::string& name);

/// The settings of a kind's element. Those of a <ring> and of each <color>, <beacon> and <at> have its name before
/// them.
std::vector<XmlSetting> settingsOf(const SensorType& type);

/// Reads a sensor from its element, `<sonar …/>` or a 2005 `<sensor>`. Reports faults to the reader's list; returns
/// null for an unknown kind.
std::unique_ptr<Sensor> readSensor(XmlReader&, const Mount&);

}  // namespace robosim
