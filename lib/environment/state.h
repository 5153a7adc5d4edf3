#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/sim_time.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "sensors/sensor.h"

namespace robosim {

/// What changes from step to step. Arrays are indexed by robot, in the world's order.
struct State {
  SimTime time;
  std::vector<mrpt::math::TPose2D> world_from_robot;
  std::vector<double> speed_mps;  ///< of the last step, after acceleration limits
  std::vector<double> turn_radps;
  std::vector<Motion> last_motion;
  std::vector<double> driven_m;       ///< length of way since the start
  std::vector<std::uint8_t> stalled;  ///< the last move was clipped or refused
  std::vector<Activity> activity;
  std::vector<float> laser_pan_rad;
  std::vector<Readings> readings;
  std::optional<std::size_t> winner;  ///< the robot that has won
  std::uint64_t stalls = 0;           ///< robot-steps that were clipped or refused, so far
  std::uint64_t messages_delivered = 0;
};

}  // namespace robosim
