#pragma once
#include "hardware/readings.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Whether a range sensor met something; otherwise the echo stands at the sensor's no_echo_m.
inline bool heard(const SensorInfo& sensor, const Echo& echo) {
  return echo.range_m < static_cast<float>(sensor.range_max_m);  // as a float: so is the reading
}

}  // namespace robosim
