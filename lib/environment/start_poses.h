#pragma once
#include <cstdint>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// Moves every robot of the fleet to a random start, the same for the same seed: somewhere that a robot could have
/// driven to from one of the world's own starts (so that a task stays possible), touching nothing, looking anywhere.
/// The widest robot decides what is reachable, on a raster of half its radius.
void shuffleStartPoses(const World& world, Fleet& fleet, std::uint64_t seed);

}  // namespace robosim
