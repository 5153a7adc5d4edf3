#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose3D.h>

#include "hardware/lens_distortion.h"
#include "hardware/measurement_times.h"
#include "hardware/raw_picture.h"

namespace robosim {

enum class SensorKind : std::uint8_t {
  sonar,
  laser,
  lidar,  ///< a laser scanner with several layers
  infrared,
  heat,
  bumper,
  odometry,
  compass,
  camera,
  blob_finder,
  battery,
  beacons,
  values,  ///< any other sensor: named numbers
  unknown  ///< of an environment of a newer version: its measurements are not decoded
};

/// Names of the kinds in files, labels and messages, in the order of SensorKind.
inline constexpr std::array kSensorKindNames{"sonar",   "laser",    "lidar",   "infrared", "heat",
                                             "bumper",  "odometry", "compass", "camera",   "blob_finder",
                                             "battery", "beacons",  "values",  "unknown"};

constexpr const char* nameOf(SensorKind kind) { return kSensorKindNames[static_cast<std::size_t>(kind)]; }
/// The kind of a name; nullopt for none of them.
std::optional<SensorKind> sensorKindNamed(std::string_view name);

/// One direction of a range sensor.
struct Beam {
  mrpt::math::TPose3D robot_from_beam;  ///< origin and direction (x axis) [m, rad]
};

mrpt::math::TPoint3D originOf(const Beam&);
/// Unit vector of the beam's direction, robot frame, when its sensor is panned by `pan_rad` about its own vertical
/// axis.
mrpt::math::TPoint3D directionOf(const Beam&, double pan_rad = 0);

/// Point at distance `range_m` from `origin` along `direction` (a unit vector), all in the robot's frame. The range has
/// single precision, as in readings, so that the point follows exactly from the reading and the mount.
inline mrpt::math::TPoint3Df pointAlong(const mrpt::math::TPoint3D& origin, const mrpt::math::TPoint3D& direction,
                                        float range_m) {
  const auto point = origin + direction * static_cast<double>(range_m);
  return {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)};
}

/// Maximum size of the JPEG file of an image [bytes].
constexpr std::size_t kPictureBytesMax = 16u << 20;

/// Camera parameters. Pixels are square, and the optical axis passes through the image centre.
struct CameraInfo {
  std::uint32_t width_px = 0;  ///< [1, kPictureSideMax_px]
  std::uint32_t height_px = 0;
  double field_of_view_rad = 0;  ///< horizontal, (0, π)
  double rate_hz = 0;            ///< images per second of simulated time, at most one per step
  LensDistortion distortion = {};
  PictureLayers layers = {};  ///< of the model `raycast`; none for the model `opengl`
  bool operator==(const CameraInfo&) const = default;

  bool isRaycast() const { return layers.any(); }

  /// Focal length [pixels]: (width / 2) / tan(field of view / 2).
  double focalLength() const;
};

/// Limits of the head of a camera that pans, tilts and zooms (hardware/camera_head.h).
struct CameraHeadLimits {
  double pan_min_rad = 0, pan_max_rad = 0;    ///< to the right, [-2π, 0]; to the left, [0, 2π]
  double tilt_min_rad = 0, tilt_max_rad = 0;  ///< down, [-π/2, 0]; up, [0, π/2]
  double zoom_max = 1;                        ///< [1, 100]
  double pan_radps = 0, tilt_radps = 0;       ///< largest speeds
  double zoom_per_s = 0;                      ///< change of the zoom per second
  bool operator==(const CameraHeadLimits&) const = default;
};

/// A number that a sensor of SensorKind::values measures.
struct Quantity {
  std::string name;  ///< "co2"
  std::string unit;  ///< "ppm"; empty for none
  bool operator==(const Quantity&) const = default;
};

/// Description of a mounted sensor for a controller; constant during a run.
struct SensorInfo {
  SensorKind kind = SensorKind::sonar;
  std::string label;          ///< unique on its robot: "sonar", "laser_2"; the rawlog's label is "<robot>/<label>"
  std::vector<Beam> beams;    ///< range sensors: one per echo, in the reading's order; bumper: one per contact segment;
                              ///< camera and blob finder: the camera's pose
  double range_min_m = 0;     ///< range sensors: smallest reported range
  double range_max_m = 0;     ///< range sensors, heat, and cameras of the model `raycast`
  double no_echo_m = 0;       ///< reading of a range sensor without an object within range_max_m; >= range_max_m
  double beam_width_rad = 0;  ///< full opening angle of one beam; 0 for a thin ray. Bumper: width of a segment
  double noise_std_m = 0;     ///< largest standard deviation of a range (at range_max_m), 0 when noise is off
  bool pans = false;          ///< beams turn with Command::laser_pan_rad; those of a camera and its blob finder with
                              ///< the aim that the head measures (aimOf())
  CameraInfo camera = {};     ///< camera, and a blob finder's camera
  std::vector<std::string> colors = {};   ///< blob finder: the names of its target colours
  std::vector<Quantity> quantities = {};  ///< values: the numbers that it measures
  double bearing_std_rad = 0;             ///< range and bearing: standard deviation of a bearing, 0 when noise is off
  CameraHeadLimits head = {};             ///< of a camera's head (CameraAim::isOf())
  /// Steps in which a reading is new. Sonars that fire in turn: those in which one of them fires. Not of a camera,
  /// which keeps no picture: CameraInfo::rate_hz.
  MeasurementTimes times = {};
};

/// Distance from the robot's centre that no beam of a range sensor exceeds [m].
double beamReach(const SensorInfo&);

}  // namespace robosim
