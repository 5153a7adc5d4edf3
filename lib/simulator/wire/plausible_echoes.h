#pragma once
#include <string>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Describes why these echoes are impossible for a correct sensor; empty when they are plausible. Each range must lie
/// in [range_min_m, range_max_m] or equal no_echo_m, and each point must lie at that range from its beam's origin.
/// @param echoes one per beam of the sensor
std::string faultOf(const Echoes& echoes, const SensorInfo& sensor);

}  // namespace robosim
