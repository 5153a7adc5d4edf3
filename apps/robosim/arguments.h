#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "robosim/cli11_names.h"

namespace robosim {

/// Accepts a finite number in [low, high].
CLI::Validator numberIn(double low, double high);
/// Accepts a whole number from 0 to 2^64 - 1; CLI11 alone would turn -1 into the largest.
CLI::Validator seedNumber();
/// Refuses an empty text, as an unset shell variable leaves behind.
CLI::Validator fileName();

/// What `--speed` says: simulated seconds a second; 0 for "max", as many as it can. @throws ConfigError
double speedNumber(const std::string& speed);

/// Adds `--patience SECONDS`: how long a client calls again when its connection breaks.
void addPatience(CLI::App& command, double& patience_s);

/// Refuses that two of a command's files are one and the same, so that none is written over another.
/// @param files what each is, as the user knows it, and its path; empty paths count for nothing
/// @throws ConfigError
void refuseSameFile(const std::vector<std::pair<std::string, std::filesystem::path>>& files);

}  // namespace robosim
