#pragma once
#include "hardware/readings.h"

namespace robosim {

/// Of a sensor that has not measured as yet: of the right kind and size.
Measurement blankMeasurement(const SensorInfo& sensor);

}  // namespace robosim
