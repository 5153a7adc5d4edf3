#pragma once
#include <mrpt/obs/CObservation.h>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// The reading that an observation of this sensor records, bit for bit, but for
///  * an echo's point, which is put on the beam's axis, at the recorded range; where it came from elsewhere,
///    takePoints() (unsensed.h) tells;
///  * a picture embedded in the recording, which comes back compressed anew (jpegOf()); its pixels are the recorded
///    ones, but for the loss of one more compression.
/// @param laser_pan_rad where the turnable sensors looked
/// @throws RecordingError when the observation's class or size is not what this sensor would have recorded.
Measurement measurementFrom(const mrpt::obs::CObservation&, const SensorInfo&, float laser_pan_rad);

}  // namespace robosim
