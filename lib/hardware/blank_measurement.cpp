#include "hardware/blank_measurement.h"

namespace robosim {

Measurement blankMeasurement(const SensorInfo& sensor) {
  switch (sensor.kind) {
    case SensorKind::sonar:
    case SensorKind::laser:
    case SensorKind::infrared:
      return Echoes(sensor.beams.size());
    case SensorKind::heat:
    case SensorKind::compass:
    case SensorKind::battery:
      return Scalar{};
    case SensorKind::bumper:
      return Contacts{std::vector<std::uint8_t>(sensor.beams.size())};
    case SensorKind::odometry:
      return Odometry{};
    case SensorKind::camera:
      return Image{};
    case SensorKind::blob_finder:
      return blankBlobs(sensor);
  }
  return Scalar{};
}

}  // namespace robosim
