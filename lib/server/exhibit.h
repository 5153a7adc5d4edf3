#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "environment/environment.h"
#include "robots/world_source.h"

namespace robosim {

/// What the conversations show to their clients: an environment, and what is constant over its run.
struct Exhibit {
  /// @param is_networked by robot: whether a process drives it, not a controller of the environment's own
  Exhibit(const Environment& environment, WorldSource source, std::uint64_t seed,
          std::vector<std::uint8_t> is_networked);

  const Environment& environment;
  WorldSource source;
  std::string world_version;
  std::uint64_t seed;
  std::vector<std::uint8_t> is_networked;
  std::vector<std::string> robot_names;
  std::unordered_map<std::string, std::size_t> robot_named;
};

}  // namespace robosim
