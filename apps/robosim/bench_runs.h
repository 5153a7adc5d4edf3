#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "benchmark/search_runs.h"

namespace robosim {

/// @throws ConfigError for several threads in a process of mpirun
void refuseThreadsOnRanks(int threads);

/// Makes the runs of a rank other than the first, which prints and writes the results.
void helpFirstRank(const NumberedRuns& source);

/// Makes the missing runs, on threads or on all ranks, and shows the progress. On ranks, the others call
/// helpFirstRank(), and both agree on the plan before.
/// @param is_interrupted ends early, with the runs that are complete
/// @param finished called with each run, by one thread at a time
void makeBenchRuns(const NumberedRuns& source, int threads, const std::function<bool()>& is_interrupted,
                   const std::function<void(const SearchRun&)>& finished, SearchRuns& runs);

/// Prints the simulated time per second of processor time of each world to standard error: timings vary between
/// repetitions, and are not part of the reproducible table.
/// @param runs of the first world, then of the second one, and so on, equally many of each
void printBenchSpeed(const std::vector<std::string>& worlds, const SearchRuns& runs);

}  // namespace robosim
