#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "robots/fleet.h"
#include "world/generation/scenery.h"

namespace robosim {

/// Random worlds that differ in their seed only, for EnvironmentBatch: scenery, robots and gold. The robots' types are
/// read once, so that a world costs no file access.
class WorldGenerator {
 public:
  /// Makes the scenery of a seed, as generateMaze() with its options (world/generation/generators.h).
  using MakeScenery = std::function<Scenery(std::uint64_t seed)>;

  /// @param make may be called from several threads at once
  /// @param name of the worlds
  /// @throws ConfigError for options out of bounds, an unknown robot type, and a world of seed 1 without enough places
  WorldGenerator(MakeScenery make, TeamOptions team, std::string name);

  /// The world of a seed. May be called from several threads at once.
  /// @throws ConfigError when it has not enough places for the robots and the gold
  LoadedWorld operator()(std::uint64_t seed) const;

 private:
  MakeScenery make_;
  TeamOptions team_;
  std::string name_;
  Fleet alike_;  ///< of any seed
};

}  // namespace robosim
