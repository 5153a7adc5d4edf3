#pragma once
#include <string>

#include "robosim/cli11_names.h"

namespace robosim {

/// Adds the option --min-time, the minimum measuring time.
/// @param of what the time applies to, for the help text
/// @param min_s its default, and later its value [s]
void addMinTime(CLI::App& command, const std::string& of, double& min_s);

}  // namespace robosim
