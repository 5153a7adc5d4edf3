#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "distributed/ranks/rank_group.h"

namespace robosim {

/// Independent tasks by number, each of which any rank can make.
struct RankTasks {
  std::vector<std::size_t> to_do;  ///< at rank 0; elsewhere it is not used
  /// Makes a task, on the calling thread. @return its result as bytes; nullopt when interrupted
  std::function<std::optional<std::string>(std::size_t task, const std::function<bool()>& is_interrupted)> make;
  std::function<void(std::size_t task, const std::string& result)> finished;  ///< called at rank 0 for each task
  std::function<bool()> is_interrupted;                                       ///< ends all early; asked on every rank
};

/// Makes the tasks on all ranks, one at a time on each; a collective operation. Rank 0 distributes them as the others
/// finish theirs, makes tasks as well, and collects all results.
/// @throws the error of the first rank that failed, on all ranks
void makeOnRanks(RankGroup& group, const RankTasks& tasks);

/// Refuses ranks that were started for different work; a collective operation.
/// @param plan all that the results depend on, as bytes
/// @throws ConfigError on all ranks when a rank's differs from that of rank 0
void requireSamePlan(RankGroup& group, const std::string& plan);

}  // namespace robosim
