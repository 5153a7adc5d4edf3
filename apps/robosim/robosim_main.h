#pragma once
#include "run/registry.h"

namespace robosim {

/// The program `robosim` with the subcommands run, replay, check, export, generate, controllers, sensors, observers
/// and bench, and
/// with additional types: an alternative to a plugin.
///
///     int main(int argc, char** argv) {
///       robosim::Registry registry;
///       registry.controllers.add({"flocking", "Moves in a flock.", …});
///       return robosim::robosimMain(argc, argv, registry);
///     }
///
/// Prints errors, also those of the registry, to standard error.
/// @return the exit code of the process
int robosimMain(int argc, char** argv, const Registry& registry);

}  // namespace robosim
