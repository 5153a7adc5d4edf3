#pragma once
#include <string>
#include <vector>

#include "base/often_default.h"
#include "base/sim_time.h"
#include "hardware/measurement.h"
#include "hardware/robot_message.h"

namespace robosim {

/// All data that a robot's hardware reports to its controller for one time step.
struct Readings {
  SimTime time;
  std::vector<Measurement> measurements;  ///< one per sensor of RobotInfo::sensors, in that order
  float laser_pan_rad = 0;                ///< pan angle of the panning sensors
  bool stalled = false;                   ///< the last motion was clipped or refused
  bool is_too_far = false;                ///< it requested CheckWin and is not near enough to the gold
  /// Sent in the last step, ordered by sender (as the world lists them), then as sent.
  OftenDefault<std::vector<RobotMessage>> inbox;
  /// The robot that has won, upon which all halt; empty while there is none, and always without a referee
  /// (Hardware::referee()).
  OftenDefault<std::string> winner;
  bool operator==(const Readings&) const = default;
};

}  // namespace robosim
