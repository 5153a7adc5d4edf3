#include "hardware/sensor_info.h"

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
  }
  return "unknown";
}

}  // namespace robosim
