#pragma once
#include <optional>
#include <vector>

#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// What a gripper measures, a sensor of SensorKind::values.
struct GripperState {
  bool is_closed = false;  ///< as commanded
  bool holds = false;      ///< an object
  /// @name Light barriers between the paddles: whether an object interrupts them
  ///@{
  bool inner_beam = false;  ///< near the robot
  bool outer_beam = false;  ///< near the tips
  ///@}
  bool operator==(const GripperState&) const = default;

  /// The names of its values, each 0 or 1, by which a sensor is known as a gripper.
  static std::vector<Quantity> quantities() {
    return {{"closed", ""}, {"holds", ""}, {"inner_beam", ""}, {"outer_beam", ""}};
  }
  static bool isOf(const SensorInfo& sensor) { return sensor.quantities == quantities(); }

  /// @pre of such a sensor
  static GripperState from(const Values& values) {
    const auto& value = values.values;
    return {value[0] != 0, value[1] != 0, value[2] != 0, value[3] != 0};
  }
  Values values() const { return {{is_closed ? 1. : 0, holds ? 1. : 0, inner_beam ? 1. : 0, outer_beam ? 1. : 0}}; }
};

}  // namespace robosim
