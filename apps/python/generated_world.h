#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include "generation/scenery.h"
#include "python_world.h"

namespace robosim {

/// A random world (generation/generators.h).
/// @param kind "maze", "cave", "office" or "open"
/// @param options of the kind, by the names of the members of its struct
/// @throws ConfigError for an unknown kind and values out of bounds; pybind11::type_error for an unknown option and a
/// value that is no number
std::shared_ptr<PythonWorld> generatedWorld(const std::string& kind, std::uint64_t seed, const TeamOptions& team,
                                            const pybind11::dict& options);

}  // namespace robosim
