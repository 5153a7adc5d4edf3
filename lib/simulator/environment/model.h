#pragma once
#include <cstdint>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// All that is constant during a run and determines it together with the commands: the world, its robots with their
/// limits and sensor options, and the run's parameters. A run is a Model and a State.
struct Model {
  World world;
  Fleet fleet;
  std::uint64_t seed = 1;
  double period_s = 0.1;  ///< length of a time step, (0, 1]
};

/// Hash that identifies a model: equal for models that behave equally, also in different processes. It covers seed and
/// time step, solids, heat and colours, communication, win distance, and the robots' names, bodies, limits, starts and
/// sensors with their options.
std::uint64_t digestOf(const Model&);

}  // namespace robosim
