#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "benchmark/case_summary.h"

namespace robosim {

/// A page with tables and charts, without links to other files.
/// @param command that makes the same report
std::string reportHtml(const SearchPlan& plan, const SearchRuns& runs, const std::string& command);

/// One line per run, with header.
std::string runsCsv(const SearchPlan& plan, const SearchRuns& runs);
/// The version of RoboSim, the command, the plan, and all runs.
std::string runsJson(const SearchPlan& plan, const SearchRuns& runs, const std::string& command);
/// One line per world, condition, team and pair of strategies.
std::string comparisonsCsv(const SearchPlan& plan, const SearchRuns& runs);

/// Writes index.html, runs.csv, runs.json, comparisons.csv, and figures/*.svg and *.pdf, each of which replaces an
/// older file when it is complete. The bytes depend on the arguments only.
/// @throws ConfigError, std::runtime_error when a file cannot be written
void writeReport(const std::filesystem::path& folder, const SearchPlan& plan, const SearchRuns& runs,
                 const std::string& command);

}  // namespace robosim
