#pragma once
#include "environment/environment.h"

namespace robosim {

/// An environment for messages that refer to one: two robots in the small maze.
inline Environment& smallMaze() {
  static LoadedWorld world = loadWorld(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", {});
  static Environment environment(world.world, world.fleet, {});
  return environment;
}

}  // namespace robosim
