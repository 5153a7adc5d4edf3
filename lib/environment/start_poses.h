#pragma once
#include <cstdint>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// Moves every robot of the fleet to a random start pose that depends only on the seed. Positions are reachable from
/// the world's own starts (so that a task stays solvable) and touch nothing; headings are uniform. Reachability is
/// computed for the widest robot, on a raster of half its radius.
void shuffleStartPoses(const World& world, Fleet& fleet, std::uint64_t seed);

}  // namespace robosim
