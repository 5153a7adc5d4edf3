#pragma once
#include "environment/state_stream.h"
#include "hardware/readings.h"

namespace robosim {

/// Writes Readings::measurements. Their kinds and sizes follow from the model.
void writeMeasurements(const Readings& readings, StateWriter& out);

/// Reads what writeMeasurements() has written. @param readings of the same kinds and sizes
/// @throws ConfigError for bytes that it cannot have written
void readMeasurements(StateReader& in, Readings& readings);

}  // namespace robosim
