#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

/// Battery voltage [V]. The charge falls at a constant rate while the robot stands, and faster while it drives or
/// turns. The voltage is linear in the charge, down to that of an empty battery. An empty battery does not stop the
/// robot.
struct BatteryOptions {
  std::string label = "battery";
  /// Values of ARCOS for a Pioneer: 13 V when charged; the robot switches itself off at 11 V.
  double full_v = 13;
  double empty_v = 11;
  /// Runtime [s] of a full battery: a Pioneer 3 with three batteries runs for eight to ten hours (data sheet). The
  /// share of standing in that is an assumption.
  double standing_s = 10 * 3600;
  double driving_s = 8 * 3600;

  /// Reads <battery>.
  static BatteryOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeBattery(const BatteryOptions&);

}  // namespace robosim
