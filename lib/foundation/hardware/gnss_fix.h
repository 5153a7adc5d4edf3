#pragma once
#include <vector>

#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// What a satellite receiver (GNSS) measures, a sensor of SensorKind::values.
struct GnssFix {
  bool is_valid = false;  ///< without a fix all numbers are 0
  /// @name WGS 84
  ///@{
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;  ///< above the ellipsoid
  ///@}
  bool operator==(const GnssFix&) const = default;

  /// The names of its values, by which a sensor is known as a receiver.
  static const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all{
        {"fix", ""}, {"latitude", "degrees"}, {"longitude", "degrees"}, {"altitude", "m"}};
    return all;
  }
  static bool isOf(const SensorInfo& sensor) { return sensor.quantities == quantities(); }

  /// @pre of such a sensor
  static GnssFix from(const Values& values) {
    const auto& value = values.values;
    return {value[0] != 0, value[1], value[2], value[3]};
  }
  Values values() const { return {{is_valid ? 1. : 0, latitude_deg, longitude_deg, altitude_m}}; }
};

}  // namespace robosim
