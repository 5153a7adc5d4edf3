#pragma once
#include <memory>

#include "control/known_world.h"
#include "robots/fleet.h"

namespace robosim {

/// The map of a world for controllers that are given it: obstacles at the heights of its robots, in cells of 0.05 m, or
/// larger ones in a world of more than 4,000,000 of these.
std::shared_ptr<const KnownWorld> makeKnownWorld(const World&, const Fleet&);

}  // namespace robosim
