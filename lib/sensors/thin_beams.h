#pragma once
#include <memory>

#include "sensors/range_noise.h"
#include "sensors/sensor.h"

namespace robosim {

/// A sensor of thin rays: laser and infrared.
/// @param info its beams, ranges and label say all that the rays need.
std::unique_ptr<Sensor> makeThinBeams(const SensorInfo& info, const RangeNoise& noise);

}  // namespace robosim
