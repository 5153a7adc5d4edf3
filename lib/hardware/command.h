#pragma once
#include <cstdint>

namespace robosim {

/// What a robot tells of itself besides moving. `found` and `halted` are final: a run ends when all robots are either.
enum class Activity : std::uint8_t {
  active,  ///< at work
  halted,  ///< done
  found,   ///< done, because it found what it was looking for (gold, a victim)
};

/// What a controller asks of its robot for the next time step. Speeds are what it wishes for: the robot's limits on
/// speed and acceleration apply. Values that are not finite count as 0.
struct Command {
  double speed_mps = 0;     ///< ahead
  double turn_radps = 0;    ///< counter-clockwise
  float laser_pan_rad = 0;  ///< for a sensor that turns, [-π/2, π/2]
  Activity activity = Activity::active;
  bool by_driver = false;  ///< a person drives the robot (doc/remote.md), not its controller
  bool operator==(const Command&) const = default;
};

}  // namespace robosim
