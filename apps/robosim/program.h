#pragma once
#include <initializer_list>

#include "robosim/cli11_names.h"

namespace robosim {

/// Parses the arguments and executes the subcommand. Prints errors as "NAME: text" to standard error.
/// @return the exit code of the process: ExitCode, or 128 + N when ended by signal N
int execute(CLI::App& program, int argc, char** argv);

/// The program `robosim` with some of its subcommands: execute() of a program with the help text of `robosim`.
/// @param add functions that add the subcommands
int executeRobosim(std::initializer_list<void (*)(CLI::App&)> add, int argc, char** argv);

}  // namespace robosim
