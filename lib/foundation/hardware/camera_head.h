#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Direction and magnification of a camera on a head that pans, tilts and zooms (PTZ), relative to its mount; what a
/// head measures, a sensor of SensorKind::values.
struct CameraAim {
  double pan_rad = 0;   ///< to the left, about the robot's vertical axis through the optical centre
  double tilt_rad = 0;  ///< up
  double zoom = 1;      ///< at least 1: by which the camera's field of view is divided
  bool operator==(const CameraAim&) const = default;

  /// The names of its values, by which a sensor is known as a camera's head.
  static const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all{{"pan", "rad"}, {"tilt", "rad"}, {"zoom", ""}};
    return all;
  }
  static bool isOf(const SensorInfo& sensor) {
    return sensor.kind == SensorKind::values && sensor.quantities == quantities();
  }

  /// @pre of such a sensor
  static CameraAim from(const Values& values) {
    const auto& value = values.values;
    return {value[0], value[1], std::max(1.0, value[2])};  // also of a robot that has measured nothing yet
  }
  Values values() const { return {{pan_rad, tilt_rad, zoom}}; }
};

/// What a controller commands to the head of its robot's camera, which moves there with limited speed.
struct CameraHeadCommand {
  CameraAim aim;  ///< the head moves to the nearest one within its limits
  /// @name Largest speeds on the way; 0 or less, or more than the head has: the head's
  ///@{
  double pan_radps = 0;
  double tilt_radps = 0;
  ///@}
  bool operator==(const CameraHeadCommand&) const = default;

  bool isFinite() const { return std::isfinite(aim.pan_rad + aim.tilt_rad + aim.zoom + pan_radps + tilt_radps); }
};

/// The aim within the limits of a head. @pre its numbers are finite
CameraAim limited(const CameraAim& aim, const CameraHeadLimits& limits);

/// The pose of a camera with this aim, whose pose in its mount is `robot_from_mount`: pan and tilt are added to the
/// mount's.
mrpt::math::TPose3D aimed(mrpt::math::TPose3D robot_from_mount, const CameraAim& aim);
/// A camera with this zoom.
CameraInfo zoomed(CameraInfo camera, double zoom);
/// A camera or blob finder with this aim, as if it was mounted so.
SensorInfo aimed(SensorInfo camera, const CameraAim& aim);

/// Index of the head among a robot's sensors, of which there is at most one; nullopt for none.
std::optional<std::size_t> cameraHeadIn(const std::vector<SensorInfo>& sensors);
/// Aim of the camera or blob finder that a sensor is; nullopt for one without a head, and for other sensors.
/// @param measurements of all sensors
std::optional<CameraAim> aimOf(const SensorInfo& camera, const std::vector<SensorInfo>& sensors,
                               const std::vector<Measurement>& measurements);

}  // namespace robosim
