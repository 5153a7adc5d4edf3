#pragma once
#include <memory>

#include "sensors/range_noise.h"
#include "sensors/sensor.h"

namespace robosim {

/// Makes a sensor of thin rays: laser, infrared, or sonars of one ray each.
/// @param info specifies beams, ranges and label
std::unique_ptr<Sensor> makeThinBeams(const SensorInfo& info, const RangeNoise& noise);

}  // namespace robosim
