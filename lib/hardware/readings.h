#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose2D.h>

#include "base/sim_time.h"
#include "hardware/robot_message.h"

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

/// Heat [°C-like units of the world file] or compass [rad, world frame, (-π, π]].
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

/// What one sensor measured in one step.
using Measurement = std::variant<Echoes, Scalar, Contacts, Odometry>;

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
