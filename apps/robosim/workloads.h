#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "robots/fleet.h"

namespace robosim {

/// A standard load for measuring speed: what each robot senses in a world of a given crowdedness (doc/performance.md).
struct Workload {
  const char* name;
  const char* help;     ///< one sentence
  const char* sensors;  ///< XML: the sensors of each robot besides odometry
  std::size_t rays;     ///< cast a robot-step, as counted in rays/s; 0 where it has no meaning
};

std::span<const Workload> workloads();
/// The workload of that name.
/// @throws std::invalid_argument
const Workload& workloadNamed(const std::string& name);

/// A square world for `robots` robots, the same for the same seed: 16 m² of ground, one box or cylinder of 0.2 m … 0.6
/// m half-width for each robot, a wall of 4 m for every four robots, and walls around. All robots are of the type that
/// has the workload's name, and wander.
LoadedWorld makeWorldToRun(const Workload& workload, std::size_t robots, std::uint64_t seed);

/// Writes that world and its type of robot into a folder.
/// @return the world's file
/// @throws std::runtime_error when the files cannot be written
std::filesystem::path writeWorld(const std::filesystem::path& folder, const Workload& workload, std::size_t robots,
                                 std::uint64_t seed);

}  // namespace robosim
