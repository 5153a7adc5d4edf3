#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "robots/fleet.h"

namespace robosim {

/// A standard workload of speed measurements: sensors of each robot in a world of given density (doc/performance.md).
struct Workload {
  const char* name;
  const char* help;     ///< one sentence
  const char* sensors;  ///< XML: the sensors of each robot besides odometry
  std::size_t rays;     ///< per robot-step, as counted in rays/s; 0 if not applicable
  double scale = 1;     ///< of all lengths and speeds of the world and its robots, but not of the sensors
};

std::span<const Workload> workloads();
/// The workload of a given name.
/// @throws std::invalid_argument
const Workload& workloadNamed(std::string_view name);

/// A square world for `robots` robots; deterministic for a seed. At scale 1: 16 m² of ground, one box or cylinder of
/// 0.2 m … 0.6 m half-width for each robot, a wall of 4 m for every four robots, and walls around. All robots are of
/// the type named after the workload, with the controller "wander".
LoadedWorld makeWorldToRun(const Workload& workload, std::size_t robots, std::uint64_t seed);

/// Writes that world and its robot type into a folder.
/// @return the world's file
/// @throws std::runtime_error when the files cannot be written
std::filesystem::path writeWorld(const std::filesystem::path& folder, const Workload& workload, std::size_t robots,
                                 std::uint64_t seed);

}  // namespace robosim
