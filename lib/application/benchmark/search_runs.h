#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "benchmark/search_run.h"

namespace robosim {

/// Results by index in the plan; nullopt: not finished.
using SearchRuns = std::vector<std::optional<SearchRun>>;

/// Makes the runs that are missing, on several threads.
/// @param finished called with each run, by one thread at a time, before it is added to `runs`
/// @throws ConfigError, ControllerError, ObserverError, and exceptions of `finished`
void makeRuns(const NumberedRuns& source, int threads, const std::function<bool()>& is_interrupted,
              const std::function<void(const SearchRun&)>& finished, SearchRuns& runs);

/// The indices of runs that are missing.
std::vector<std::size_t> missing(const SearchRuns& runs);

}  // namespace robosim
