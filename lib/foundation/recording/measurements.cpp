#include "recording/measurements.h"

#include "recording/codecs.h"

namespace robosim {

Measurement measurementFrom(const mrpt::obs::CObservation& observation, const SensorInfo& sensor, float laser_pan_rad,
                            const std::filesystem::path& pictures) {
  return findCodec(sensor).measurementFrom(observation, sensor, laser_pan_rad, pictures);
}

}  // namespace robosim
