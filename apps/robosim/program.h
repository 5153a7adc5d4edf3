#pragma once
#include <functional>
#include <initializer_list>

#include "robosim/cli11_names.h"

namespace robosim {

/// Replaces the arguments `help SUBCOMMAND` by `SUBCOMMAND --help`.
void replaceHelpSubcommand(int argc, char** argv);

/// Parses the arguments and executes the subcommand. Prints errors as "NAME SUBCOMMAND: text" to standard error.
/// @param add_all findArgumentError()
/// @return the exit code of the process: ExitCode, or 128 + N when ended by signal N
int execute(CLI::App& program, int argc, char** argv, const std::function<void(CLI::App&)>& add_all = {});

/// The program `robosim` with some of its subcommands: execute() of a program with the help text of `robosim`.
/// @param add functions that add the subcommands
int executeRobosim(std::initializer_list<void (*)(CLI::App&)> add, int argc, char** argv,
                   const std::function<void(CLI::App&)>& add_all = {});

}  // namespace robosim
