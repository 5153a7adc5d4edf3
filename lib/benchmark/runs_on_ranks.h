#pragma once
#include <functional>

#include "benchmark/search_runs.h"
#include "ranks/rank_group.h"

namespace robosim {

/// A collective operation. @throws ConfigError on all ranks if the plans, which contain a digest of each world, differ
void requireSamePlan(RankGroup& group, const SearchPlan& plan);

/// makeRuns() on all ranks, one run at a time on each; a collective operation. Rank 0 distributes the runs as the
/// others finish theirs, makes runs as well, and collects all results. Every rank has a benchmark of the same plan.
/// @param finished, runs of rank 0
/// @throws the error of the first rank that failed, on all ranks
void makeRunsOnRanks(RankGroup& group, const SearchBenchmark& benchmark, const std::function<bool()>& is_interrupted,
                     const std::function<void(const SearchRun&)>& finished, SearchRuns& runs);

}  // namespace robosim
