#pragma once
#include <memory>

#include "sensors/sensor.h"

namespace robosim {

/// What the beams of a laser meet, for programs that recognise reflectors. An Echo's range_m is the share of light that
/// the body returns (Body::reflectivity), and 0 without a body within range_max_m; its point is not set.
/// @param laser whose beams, limits and label it has; its pan is not followed
std::unique_ptr<Sensor> makeReflectance(const SensorInfo& laser);

}  // namespace robosim
