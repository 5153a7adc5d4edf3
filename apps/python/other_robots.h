#pragma once
#include "learning/environment_batch.h"
#include "robots/fleet.h"

namespace robosim {

/// Checks whether the robots of a world from number `first` on can be driven by the controllers that the world names.
/// @throws ConfigError for a controller that requires a sensor which its robot does not have, or pictures
void checkOtherRobots(const LoadedWorld& world, std::size_t first);

/// Drives robots by the controllers that their world names; those for which it names none stand still.
/// @param first number of the first of these robots
/// @throws ConfigError as checkOtherRobots(), ControllerError for an exception of a controller's constructor
std::unique_ptr<OtherRobots> otherRobots(Environment& environment, std::size_t first);

}  // namespace robosim
