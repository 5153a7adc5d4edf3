#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

/// Voltage drop of a loaded battery: its internal resistance times the current of the motors, which is proportional to
/// the speed (friction) and to the turn rate (scrub). The charge then follows from the time and the distance driven, as
/// if that had been driven at `speed_mps`, because a reading with a drop does not determine the charge. Omitted:
/// acceleration, payload, recovery of the cells, and the charge that turning takes.
struct BatteryLoad {
  bool on = false;
  double drop_v_per_mps = 0;    ///< [0, 100]
  double drop_v_per_radps = 0;  ///< [0, 100]
  double speed_mps = 0.5;       ///< at which the battery lasts BatteryOptions::driving_s, (0, 100]
  double noise_std_v = 0;       ///< of a reading, [0, 100]
};

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
  BatteryLoad load;

  /// Reads <battery>.
  static BatteryOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeBattery(const BatteryOptions&);

}  // namespace robosim
