#pragma once
#include "hardware/sensor_info.h"
#include "rendering/color.h"

namespace robosim {

/// Colour of a sensor's ranges in views.
inline Color sensorColor(SensorKind kind) {
  return kind == SensorKind::laser      ? Color{0.86f, 0.20f, 0.25f}
         : kind == SensorKind::infrared ? Color{0.55f, 0.25f, 0.70f}
         : kind == SensorKind::beacons  ? Color{0.10f, 0.55f, 0.35f}
         : kind == SensorKind::values   ? Color{0.80f, 0.45f, 0.05f}
                                        : Color{0.16f, 0.47f, 0.86f};
}

}  // namespace robosim
