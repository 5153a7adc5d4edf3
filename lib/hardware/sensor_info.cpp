#include "hardware/sensor_info.h"

#include <cmath>

namespace robosim {

const char* nameOf(SensorKind kind) {
  switch (kind) {
    case SensorKind::sonar:
      return "sonar";
    case SensorKind::laser:
      return "laser";
    case SensorKind::infrared:
      return "infrared";
    case SensorKind::heat:
      return "heat";
    case SensorKind::bumper:
      return "bumper";
    case SensorKind::odometry:
      return "odometry";
    case SensorKind::compass:
      return "compass";
    case SensorKind::camera:
      return "camera";
    case SensorKind::blob_finder:
      return "blob_finder";
  }
  return "unknown";
}

double CameraInfo::focalLength_px() const { return width_px / 2.0 / std::tan(field_of_view_rad / 2); }

}  // namespace robosim
