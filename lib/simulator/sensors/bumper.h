#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"

namespace robosim {

/// Ring of contact segments around the robot's body, counter-clockwise; the first is centred straight ahead. The edge
/// of the surface presses segments as a wall does.
struct BumperOptions {
  std::string label = "bumper";
  int segments = 12;          ///< [3, 360]
  double travel_m = 0.002;    ///< (0, 0.1]: anything within this distance of the body presses a segment
  double robot_radius_m = 0;  ///< set from the robot, not from the element
  /// Probability that a segment reads the wrong state in a step while its contact bounces, [0, 1]: always when it is
  /// touched, by the shaking of the robot, and in the first step after that. Bounces last some milliseconds, and each
  /// step samples them once, so that the steps are independent. The state before is the old reading.
  double chatter = 0;
  double z_m = 0;  ///< height of the ring above the robot's underside; default half the robot's height

  /// Reads <bumper>.
  static BumperOptions read(XmlReader&, const Mount&);
};

std::unique_ptr<Sensor> makeBumper(const BumperOptions&);

}  // namespace robosim
