#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose2D.h>

#include "base/sim_time.h"
#include "hardware/robot_message.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// One range and where it was met. Single precision, as MRPT's observations keep ranges: a recorded reading is the
/// reading. Something nearer than the sensor's range_min_m reads range_min_m, while the point is where it was met.
/// Nothing nearer than the sensor's range_max_m: range_m is the sensor's no_echo_m, and the point lies that far along
/// the beam.
struct Echo {
  float range_m = 0;              ///< from the sensor
  mrpt::math::TPoint3Df point_m;  ///< robot frame
  bool operator==(const Echo&) const = default;
};

/// Sonar, laser, infrared: an echo per beam of the sensor's SensorInfo.
using Echoes = std::vector<Echo>;

/// Heat [°C-like units of the world file], compass [rad, world frame, (-π, π]] or battery [V].
struct Scalar {
  double value = 0;
  bool operator==(const Scalar&) const = default;
};

/// Bumper: whether anything touches a segment, one per beam of the sensor's SensorInfo.
struct Contacts {
  std::vector<std::uint8_t> pressed;  ///< 0 or 1
  bool operator==(const Contacts&) const = default;
};

/// Wheel odometry since the start of the run.
struct Odometry {
  mrpt::math::TPose2D odom_from_robot;  ///< (0,0,0) at the start [m, rad]
  double speed_mps = 0;                 ///< of the last step, as the wheels tell
  double turn_radps = 0;
  bool operator==(const Odometry&) const = default;
};

/// Camera: a colour picture. How it looks to the last bit depends on the machine (doc/decisions/pictures.md).
struct Image {
  std::string jpeg;  ///< a JPEG file's bytes; empty in a step in which the camera takes none because of its rate
  bool operator==(const Image&) const = default;
};

/// The largest connected spot of one colour. Pixels are counted to the right and down; (0, 0) is the middle of the
/// upper left one.
struct Blob {
  std::string color;         ///< its name: SensorInfo::colors has the same
  std::uint32_t pixels = 0;  ///< of the spot; 0 for none in the picture, and then all that follows is 0
  float x_px = 0;            ///< its centroid
  float y_px = 0;
  std::uint32_t left_px = 0;  ///< the box round it: its first column and row, and how many of each
  std::uint32_t top_px = 0;
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  bool operator==(const Blob&) const = default;
};

/// Blob finder: what it found in its camera's picture.
struct Blobs {
  bool taken = false;          ///< whether there was a picture in this step
  std::vector<Blob> of_color;  ///< one for each of SensorInfo::colors, in their order
  bool operator==(const Blobs&) const = default;
};

/// No picture as yet, and every colour's name.
inline Blobs blankBlobs(const SensorInfo& blob_finder) {
  Blobs blobs;
  for (const auto& color : blob_finder.colors) blobs.of_color.push_back({.color = color});
  return blobs;
}

/// What one sensor measured in one step.
using Measurement = std::variant<Echoes, Scalar, Contacts, Odometry, Image, Blobs>;

/// Everything that a robot's hardware tells its controller of one time step, in one packet.
struct Readings {
  SimTime time;
  std::vector<Measurement> measurements;  ///< one per sensor of RobotInfo::sensors, in that order
  bool stalled = false;                   ///< the last move was clipped or refused
  float laser_pan_rad = 0;                ///< where the turnable sensors looked
  std::vector<RobotMessage>
      inbox;                ///< sent in the last step, ordered by sender (as the world lists them), then as sent
  std::string winner;       ///< the robot that has won: then all halt. Empty for as long as none has
  bool is_too_far = false;  ///< this robot has asked whether it has won, and is not near enough to the gold
};

}  // namespace robosim
