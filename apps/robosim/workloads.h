#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "robots/fleet.h"

namespace robosim {

/// A standard load for measuring speed: what each robot senses, and how crowded its world is (doc/performance.md).
struct Workload {
  const char* name;
  const char* help;     ///< one sentence
  const char* sensors;  ///< XML: the sensors of each robot besides odometry
  std::size_t rays;     ///< cast a robot-step, as counted in rays/s; 0 where it has no meaning
};

std::span<const Workload> workloads();
/// @throws ConfigError naming the known ones.
const Workload& workloadNamed(const std::string& name);

/// A square world for `robots` robots, the same for the same seed: 16 m² of ground, one box or cylinder of 0.2 m … 0.6
/// m half-width for each robot, a wall of 4 m for every four robots, and walls around. All robots wander.
LoadedWorld makeWorld(const Workload& workload, std::size_t robots, std::uint64_t seed);

}  // namespace robosim
