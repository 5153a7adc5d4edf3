#pragma once
#include <vector>

#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// What an inertial sensor (IMU) measures, a sensor of SensorKind::values, in the robot's frame: means over the last
/// step.
struct InertialReading {
  double turn_radps = 0;  ///< about the vertical axis, counter-clockwise
  /// @name Specific force: at rest it is gravity, upwards
  ///@{
  double ahead_mps2 = 0, left_mps2 = 0, up_mps2 = 0;
  ///@}
  bool operator==(const InertialReading&) const = default;

  /// The names of its values, by which a sensor is known as an inertial one.
  static const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all{
        {"turn_rate", "rad/s"}, {"accel_x", "m/s²"}, {"accel_y", "m/s²"}, {"accel_z", "m/s²"}};
    return all;
  }
  static bool isOf(const SensorInfo& sensor) { return sensor.quantities == quantities(); }

  /// @pre of such a sensor
  static InertialReading from(const Values& values) {
    const auto& value = values.values;
    return {value[0], value[1], value[2], value[3]};
  }
  Values values() const { return {{turn_radps, ahead_mps2, left_mps2, up_mps2}}; }
};

}  // namespace robosim
