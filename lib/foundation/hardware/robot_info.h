#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/often_default.h"
#include "base/shared_value.h"
#include "hardware/drive.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Limits on a robot's speed and acceleration.
struct MotionLimits {
  double speed_max_mps = 0;
  double turn_max_radps = 0;
  double accel_mps2 = 0;         ///< speeding up
  double decel_mps2 = 0;         ///< slowing down
  double turn_accel_radps2 = 0;  ///< both
  /// Slowing down in an emergency stop (Command::emergency_stop), in which the turn brakes harder in the same
  /// proportion; one below decel_mps2, such as 0, has no effect: the robot then brakes as always.
  double emergency_decel_mps2 = 0;
  double lateral_max_mps = 0;  ///< sideways; 0 for drives that are not omnidirectional
  bool operator==(const MotionLimits&) const = default;
};

/// What robots of a type have in common besides their bodies and sensors.
struct RobotTypeInfo {
  std::string model;  ///< "pioneer3dx", "scout"; "2005" for a robot defined in the world file
  MotionLimits limits;
  Drive drive{};
  bool operator==(const RobotTypeInfo&) const = default;
};

/// Description of a robot for its controller; constant during a run. Small, because a run may have very many robots.
struct RobotInfo {
  std::string name;
  SharedValue<RobotTypeInfo> type;      ///< shared by all robots of a model
  OftenDefault<std::string> neighbour;  ///< the robot to which it forwards GOLD; empty for none
  double radius_m = 0;                  ///< radius of its circular footprint
  double height_m = 0;
  std::shared_ptr<const std::vector<SensorInfo>> sensors;  ///< the same
  std::optional<std::uint32_t> color_rgb{};                ///< 0xRRGGBB, as in all views; nullopt if unknown
};

}  // namespace robosim
