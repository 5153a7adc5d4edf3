#pragma once
#include <barrier>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "distributed/ranks/rank_group.h"

namespace robosim {

/// Runs a function on several ranks that are threads of this process, without MPI, and returns when all have returned.
/// The first exception, by rank, is thrown again; a rank whose function throws must not leave others in an operation.
void runThreadRanks(int ranks, const std::function<void(RankGroup& group)>& function);

}  // namespace robosim
