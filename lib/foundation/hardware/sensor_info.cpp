#include "hardware/sensor_info.h"

#include <algorithm>

#include "base/portable_math.h"

namespace robosim {

using mrpt::math::TPoint3D;

TPoint3D originOf(const Beam& beam) {
  const auto& pose = beam.robot_from_beam;
  return {pose.x, pose.y, pose.z};
}

TPoint3D directionOf(const Beam& beam, double pan_rad) {
  const auto& pose = beam.robot_from_beam;
  // MRPT's pitch is positive downwards.
  const auto [down, level] = portable::sincos(pose.pitch);
  const auto yaw = portable::sincos(pose.yaw);
  const TPoint3D ahead(level * yaw.cos, level * yaw.sin, -down);
  if (pan_rad == 0) return ahead;
  const auto [sin, cos] = portable::sincos(pan_rad);
  return {cos * ahead.x - sin * ahead.y, sin * ahead.x + cos * ahead.y, ahead.z};
}

std::optional<SensorKind> sensorKindNamed(std::string_view name) {
  const auto found = std::find(kSensorKindNames.begin(), kSensorKindNames.end(), name);
  if (found == kSensorKindNames.end()) return std::nullopt;
  return static_cast<SensorKind>(found - kSensorKindNames.begin());
}

double beamReach(const SensorInfo& info) {
  double reach_m = 0;
  for (const auto& beam : info.beams) {
    reach_m = std::max(reach_m, info.range_max_m + portable::hypot(beam.robot_from_beam.x, beam.robot_from_beam.y));
  }
  return reach_m;
}

double CameraInfo::focalLength() const {
  const auto [sin, cos] = portable::sincos(field_of_view_rad / 2);
  return width_px / 2.0 * cos / sin;
}

}  // namespace robosim
