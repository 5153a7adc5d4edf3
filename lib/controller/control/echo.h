#pragma once
#include "hardware/readings.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Whether a range sensor detected something; otherwise the range equals the sensor's no_echo_m.
inline bool isEcho(const SensorInfo& sensor, const Echo& echo) {
  return echo.range_m < static_cast<float>(sensor.range_max_m);  // compared as float, the type of the reading
}

}  // namespace robosim
