#pragma once
#include <memory>
#include <span>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

/// What a sensor's reader may need to know of the robot that carries it.
struct Mount {
  double unit_m = 1;  ///< a length unit of the file, in metres; only 2005's <sensor> uses it
  double robot_radius_m = 0;
  double robot_height_m = 0;
  std::span<const std::shared_ptr<const Sensor>> mounted = {};  ///< what is mounted already, by slot
};

/// A kind of sensor, and how its element in a file is read.
struct SensorType {
  const char* name;  ///< the element's tag in a robot type: <sonar …/>; <type> in a 2005 <sensor>
  const char* help;  ///< one sentence
  std::unique_ptr<Sensor> (*read)(XmlReader&, const Mount&);
  /// Reads 2005's <sensor>; null for a kind that 2005 had not.
  std::unique_ptr<Sensor> (*read_2005)(XmlReader&, const Mount&);
};

/// Every kind of sensor there is.
std::span<const SensorType> sensorTypes();

/// Reads a sensor from its element, `<sonar …/>` or 2005's `<sensor>`; reports faults to the reader's list, and returns
/// null for a kind that does not exist.
std::unique_ptr<Sensor> readSensor(XmlReader&, const Mount&);

}  // namespace robosim
