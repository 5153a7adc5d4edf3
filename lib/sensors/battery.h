#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

/// Voltage of the battery [V]. Its charge goes down evenly while the robot stands, and faster while it drives or turns;
/// the voltage falls with the charge in a straight line, down to that of an empty one, and no further: a robot with an
/// empty battery is not stopped.
struct BatteryOptions {
  std::string label = "battery";
  /// As ARCOS has it for a Pioneer: 13 V when charged, and at 11 V the robot would switch itself off.
  double full_v = 13;
  double empty_v = 11;
  /// How long a full one lasts [s]: a Pioneer 3 with three batteries runs for eight to ten hours (data sheet). How much
  /// of that is standing is assumed.
  double standing_s = 10 * 3600;
  double driving_s = 8 * 3600;

  /// Reads <battery>.
  static BatteryOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeBattery(const BatteryOptions&);

}  // namespace robosim
