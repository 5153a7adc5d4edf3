#pragma once
#include <functional>

#include "benchmark/search_runs.h"
#include "distributed/ranks/rank_group.h"

namespace robosim {

/// makeRuns() on all ranks, one run at a time on each; a collective operation (makeOnRanks()). Every rank has a source
/// of the same plan.
/// @param finished, runs of rank 0
/// @throws the error of the first rank that failed, on all ranks
void makeRunsOnRanks(RankGroup& group, const NumberedRuns& source, const std::function<bool()>& is_interrupted,
                     const std::function<void(const SearchRun&)>& finished, SearchRuns& runs);

}  // namespace robosim
