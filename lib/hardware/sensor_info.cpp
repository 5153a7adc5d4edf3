#include "hardware/sensor_info.h"

#include <cmath>

namespace robosim {

using mrpt::math::TPoint3D;

TPoint3D originOf(const Beam& beam) {
  const auto& pose = beam.robot_from_beam;
  return {pose.x, pose.y, pose.z};
}

TPoint3D directionOf(const Beam& beam, double pan_rad) {
  const auto& pose = beam.robot_from_beam;
  // MRPT's pitch is positive downwards.
  const double level = std::cos(pose.pitch);
  const TPoint3D ahead(level * std::cos(pose.yaw), level * std::sin(pose.yaw), -std::sin(pose.pitch));
  if (pan_rad == 0) return ahead;
  const double cos = std::cos(pan_rad);
  const double sin = std::sin(pan_rad);
  return {cos * ahead.x - sin * ahead.y, sin * ahead.x + cos * ahead.y, ahead.z};
}

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
    case SensorKind::battery:
      return "battery";
  }
  return "unknown";
}

double CameraInfo::focalLength() const { return width_px / 2.0 / std::tan(field_of_view_rad / 2); }

}  // namespace robosim
