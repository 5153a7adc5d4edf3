#pragma once
#include "environment/state_stream.h"
#include "hardware/readings.h"

namespace robosim {

/// Writes Readings::measurements. Their kinds and sizes follow from the model.
void writeMeasurements(const Readings& readings, StateWriter& out);

/// Which numbers readMeasurements() accepts.
enum class NumberCheck {
  permitted,  ///< those that sensors of RoboSim measure (isPermitted()), for files
  none        ///< any, as sensors of plugins may measure, for bytes of another process of the same run
};

/// Reads what writeMeasurements() has written. @param readings of the same kinds and sizes
/// @throws InvalidContents for bytes that it cannot have written, or numbers that are not accepted
void readMeasurements(StateReader& in, Readings& readings, NumberCheck check);

}  // namespace robosim
