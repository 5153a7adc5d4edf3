#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "robosim/cli11_names.h"

namespace robosim {

/// Adds the subcommand `gold` of `robosim bench`.
void addBenchGold(CLI::App& parent);

/// Adds `--runs` and `--seed` of subcommands of `robosim bench`.
void addRunsAndSeed(CLI::App& command, int& runs, std::uint64_t& seed);
/// Adds `--controller`, repeatable, which accepts lists of values.
void addControllersOption(CLI::App& command, std::vector<std::string>& controllers);
/// The choices of `--controller` with their lists of values expanded; one empty choice for none. @throws ConfigError
std::vector<std::string> allControllers(const std::vector<std::string>& given);

}  // namespace robosim
