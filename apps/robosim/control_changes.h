#pragma once
#include <functional>

#include <CLI/CLI.hpp>

#include "world/intervention.h"

namespace robosim {

/// Adds the subcommands of 'robosim control' that change the run from outside: place, add, remove, change, activity,
/// end.
/// @param supervise applies a change to the run
void addChanges(CLI::App& control, const std::function<void(const Change&)>& supervise);

}  // namespace robosim
