#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose3D.h>

namespace robosim {

enum class SensorKind : std::uint8_t {
  sonar,
  laser,
  infrared,
  heat,
  bumper,
  odometry,
  compass,
  camera,
  blob_finder,
  battery
};

/// The word for a kind in files, labels and messages: "sonar", "laser", …
const char* nameOf(SensorKind);

/// One direction of a range sensor.
struct Beam {
  mrpt::math::TPose3D robot_from_beam;  ///< where it starts and looks (x ahead) [m, rad]
};

mrpt::math::TPoint3D originOf(const Beam&);
/// Unit vector along which the beam looks, robot frame, when its sensor has turned by `pan_rad` about its own vertical.
mrpt::math::TPoint3D directionOf(const Beam&, double pan_rad = 0);

/// Where an echo comes from that was heard along `direction` (a unit vector) of a sensor at `origin`, all in the
/// robot's frame. The range is taken as it is told, in single precision: so whoever knows the reading and the mount
/// knows the point, to the last bit.
inline mrpt::math::TPoint3Df pointAlong(const mrpt::math::TPoint3D& origin, const mrpt::math::TPoint3D& direction,
                                        float range_m) {
  const auto point = origin + direction * static_cast<double>(range_m);
  return {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)};
}

/// Width and height of a picture are at most this [pixels], and its JPEG file is no larger than that.
constexpr std::uint32_t kPictureSideMax_px = 2048;
constexpr std::size_t kPictureBytesMax = 16u << 20;

/// A camera's picture. Pixels are square, and the optical axis goes through the picture's middle.
struct CameraInfo {
  std::uint32_t width_px = 0;  ///< [1, kPictureSideMax_px]
  std::uint32_t height_px = 0;
  double field_of_view_rad = 0;  ///< from the left edge to the right one, (0, π)
  double rate_hz = 0;            ///< pictures a second of simulated time, if steps are short enough
  bool operator==(const CameraInfo&) const = default;

  /// Distance of the picture's plane from the eye, in pixels: (width / 2) / tan(field of view / 2).
  double focalLength() const;
};

/// What a controller may know of a mounted sensor: constant over a run.
struct SensorInfo {
  SensorKind kind = SensorKind::sonar;
  std::string label;          ///< unique on its robot: "sonar", "laser_2"; the rawlog's label is "<robot>/<label>"
  std::vector<Beam> beams;    ///< range sensors: one per echo, in the reading's order; bumper: one per contact segment;
                              ///< camera and blob finder: where the camera sits and looks
  double range_min_m = 0;     ///< range sensors: nearest distance told
  double range_max_m = 0;     ///< range sensors and heat
  double no_echo_m = 0;       ///< what a range sensor reads when nothing is nearer than range_max_m; >= range_max_m
  double beam_width_rad = 0;  ///< full opening angle of one beam; 0 for a thin ray. Bumper: width of a segment
  double noise_std_m = 0;     ///< standard deviation of a range, 0 when noise is off
  bool pans = false;          ///< beams turn with Command::laser_pan_rad
  CameraInfo camera = {};     ///< camera, and a blob finder's camera
  std::vector<std::string> colors = {};  ///< blob finder: the names of what it looks for
};

}  // namespace robosim
