#pragma once
#include <cstdint>

#include "base/often_default.h"
#include "hardware/camera_head.h"

namespace robosim {

/// State of a robot's task. `found` and `halted` are final: a run ends when every robot is in one of them.
enum class Activity : std::uint8_t {
  active,  ///< working
  halted,  ///< finished
  found,   ///< finished because it found its target (gold, a victim)
  absent,  ///< not in the world at present, so that nothing senses it; has no effect in a command
};

/// Command of a controller to its robot for the next time step. Speeds are set points: the robot's limits on speed and
/// acceleration apply. Values that are not finite are treated as 0.
struct Command {
  double speed_mps = 0;     ///< ahead
  double turn_radps = 0;    ///< counter-clockwise
  float laser_pan_rad = 0;  ///< of sensors that pan, [-π/2, π/2]
  Activity activity = Activity::active;
  bool by_driver = false;  ///< commanded by a person (doc/remote_control.md), not by the controller
  /// Brakes at MotionLimits::emergency_decel_mps2, whatever the set points of the speeds.
  bool emergency_stop = false;
  /// Closes the gripper, which then holds what is between its paddles; otherwise it is open, and holds nothing. Without
  /// effect on a robot without a gripper.
  bool grip = false;
  /// Colour of the robot's LEDs, 0xRRGGBB (hardware/led_color.h); 0: off.
  std::uint32_t led_color = 0;
  double lateral_mps = 0;  ///< to the left; without effect on a robot whose drive is not omnidirectional
  /// Without effect on a robot without a camera that pans, tilts and zooms.
  OftenDefault<CameraHeadCommand> camera_head = {};
  bool operator==(const Command&) const = default;

  /// A command for an active robot at rest that leaves its devices as they are: pan angle, gripper, LEDs and
  /// the camera's head.
  Command keepingDevices() const {
    return {.laser_pan_rad = laser_pan_rad, .grip = grip, .led_color = led_color, .camera_head = camera_head};
  }
};

}  // namespace robosim
