#pragma once
#include <mrpt/obs/CObservation.h>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// The reading that an observation of this sensor records. What cannot come back:
///  * an echo's point is put on the beam's axis, at the recorded range. A thin beam's point is there anyway, but for
///    rounding (1e-6 m); a wide sonar's nearest point may have been off the axis by up to half the beam's width;
///  * heat keeps single precision;
///  * a picture embedded in the recording comes back compressed anew (jpegOf()); its pixels are the recorded ones, but
///    for the loss of one more compression.
/// @throws RecordingError when the observation's class or size is not what this sensor would have recorded.
Measurement measurementFrom(const mrpt::obs::CObservation&, const SensorInfo&);

}  // namespace robosim
