#pragma once
#include <string>

#include "robosim/cli11_names.h"
#include "run/run_arguments.h"

namespace robosim {

/// Adds WORLD and the options of RunArguments.
void addRunArguments(CLI::App& command, RunArguments& arguments);

/// @throws ConfigError for errors that can be detected before the run.
void checkRunArguments(const RunArguments& arguments);

/// The list of controllers, for the footer of a help text.
std::string controllersHelp();

}  // namespace robosim
