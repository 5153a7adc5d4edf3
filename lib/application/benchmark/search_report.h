#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "benchmark/case_summary.h"

namespace robosim {

/// The page of a run (SearchBenchmark::writePage()).
struct RunPageLink {
  std::size_t run = 0;  ///< index
  std::string file;     ///< relative to the report's folder, of letters, digits and "-_./"
};

/// Runs of each strategy that are worth watching: of those in the order of their times to the gold, without success
/// last, `count` at equal distances from the first to the last. One: the fastest. Two: the fastest, and a run without
/// success or else the slowest.
std::vector<RunPageLink> chooseRuns(const SearchPlan& plan, const SearchRuns& runs, std::size_t count);

/// A page with tables and charts, without links to other files but the pages of runs.
/// @param command that makes the same report
std::string reportHtml(const SearchPlan& plan, const SearchRuns& runs, const std::string& command,
                       const std::vector<RunPageLink>& pages);

/// One line per run, with header.
std::string runsCsv(const SearchPlan& plan, const SearchRuns& runs);
/// The version of RoboSim, the command, the plan, and all runs.
std::string runsJson(const SearchPlan& plan, const SearchRuns& runs, const std::string& command);
/// One line per world, condition, team and pair of strategies.
std::string comparisonsCsv(const SearchPlan& plan, const SearchRuns& runs);

/// Writes runs.csv, runs.json, comparisons.csv, and figures/*.svg and *.pdf, each of which replaces an older file when
/// it is complete. The bytes depend on the arguments only.
/// @throws ConfigError, std::runtime_error when a file cannot be written
void writeReportData(const std::filesystem::path& folder, const SearchPlan& plan, const SearchRuns& runs,
                     const std::string& command);
/// Likewise index.html: after all else, so that it stands for a complete report.
void writeReportPage(const std::filesystem::path& folder, const SearchPlan& plan, const SearchRuns& runs,
                     const std::string& command, const std::vector<RunPageLink>& pages);

}  // namespace robosim
