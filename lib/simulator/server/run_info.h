#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "environment/environment.h"
#include "robots/world_source.h"

namespace robosim {

/// An environment and the constants of its run, as served to clients.
struct RunInfo {
  /// @param is_networked by robot: whether a process drives it instead of a controller in the environment
  RunInfo(const Environment& environment, WorldSource source, std::uint64_t seed,
          std::vector<std::uint8_t> is_networked);

  /// Adds the robots that interventions have added to the environment, and their types to the source.
  /// @param are_networked of these robots
  void addRobots(const std::vector<std::uint8_t>& are_networked);

  const Environment& environment;
  WorldSource source;
  std::string world_version;
  std::string run_id;  ///< random: different for each run, even of the same world and seed
  std::uint64_t seed;
  std::vector<std::uint8_t> is_networked;
  std::vector<std::string> robot_names;
  std::unordered_map<std::string, std::size_t> robot_named;
};

}  // namespace robosim
