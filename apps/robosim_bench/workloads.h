#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "robots/fleet.h"

namespace robosim {

/// A workload of speed measurements: robots of one kind in a world of given density (doc/performance.md).
struct Workload {
  std::string name;
  std::string help;       ///< one sentence
  std::string sensors;    ///< XML: the sensors of each robot besides odometry; empty with `has_type`
  std::size_t rays = 0;   ///< per robot-step, as counted in rays/s; 0 if not applicable
  double scale = 1;       ///< of all lengths and speeds of the world and its robots, but not of the sensors
  bool has_type = false;  ///< its robots are of the robot type `name` (worlds/robots/), not of one made of `sensors`
};

/// The standard workloads.
std::span<const Workload> workloads();
/// The workload of a given name.
/// @throws std::invalid_argument
const Workload& workloadNamed(std::string_view name);
/// The workload whose robots are of a robot type.
/// @throws ConfigError for an unknown or faulty type
Workload workloadOfType(const std::string& robot_type);
/// Names of all robot types that are found without a world file.
std::vector<std::string> robotTypeNames();

/// A square world for `robots` robots; deterministic for a seed. At scale 1: 16 m² of ground, one box or cylinder of
/// 0.2 m … 0.6 m half-width for each robot, a wall of 4 m for every four robots, and walls around. All robots are of
/// the type named after the workload, with the controller "wander".
LoadedWorld makeWorldToRun(const Workload& workload, std::size_t robots, std::uint64_t seed);

/// Writes that world, and its robot type unless it is one of worlds/robots/, into a folder.
/// @return the world's file
/// @throws std::runtime_error when the files cannot be written
std::filesystem::path writeWorld(const std::filesystem::path& folder, const Workload& workload, std::size_t robots,
                                 std::uint64_t seed);

}  // namespace robosim
