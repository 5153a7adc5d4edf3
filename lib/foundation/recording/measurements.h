#pragma once
#include <filesystem>

#include <mrpt/obs/CObservation.h>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Converts an observation of this sensor back to the recorded reading. The result is exact, except for
///  * an echo's point, which is placed on the beam's axis at the recorded range; restorePoints()
///    (robot_status_record.h) restores points off the axis;
///  * an embedded image, which is compressed again (extractJpeg()), with the loss of one more compression.
/// @param laser_pan_rad pan angle of the panning sensors
/// @param pictures RawlogReader::pictureFolder(), for external images
/// @throws RecordingError when the observation's class or size does not match the sensor.
Measurement measurementFrom(const mrpt::obs::CObservation&, const SensorInfo&, float laser_pan_rad,
                            const std::filesystem::path& pictures = {});

}  // namespace robosim
