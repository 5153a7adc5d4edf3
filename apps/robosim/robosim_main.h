#pragma once
#include "run/registry.h"

namespace robosim {

/// The program `robosim` with additional types: an alternative to a plugin.
///
///     int main(int argc, char** argv) {
///       robosim::Registry registry;
///       registry.controllers.add({"flocking", "Moves in a flock.", …});
///       return robosim::robosimMain(argc, argv, registry);
///     }
///
/// Has all subcommands. Those that use a network or windows are in the libraries robosim-serving and robosim-viewing,
/// which are loaded when one of them is requested. Prints errors, also those of the registry, to standard error.
/// @return the exit code of the process
int robosimMain(int argc, char** argv, const Registry& registry);

}  // namespace robosim
