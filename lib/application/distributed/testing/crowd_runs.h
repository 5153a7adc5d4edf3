#pragma once
#include <string>
#include <vector>

#include "distributed/distributed_run.h"
#include "robots/fleet.h"

namespace robosim {

/// Registers the controller "dasher" in this process. It drives fast, turns at random and away from what its laser
/// sees. Some robots send messages to one robot or to all, upon which the receivers turn, ask whether they have won, or
/// halt.
void addDasher();

/// What a run has in common with one in one process.
std::string resultOf(const LocalRun& run);
/// In one process.
std::string resultAlone(const LoadedWorld& world, int steps);

struct OnRanks {
  std::string result;
  std::string exchange;  ///< DistributedRun::exchangeText()
  std::vector<DistributedRun::Measured> measured;
};
/// On ranks that are threads of this process, and have one or two threads each.
OnRanks runOf(const LoadedWorld& world, int steps, int ranks, DistributionOptions options);

}  // namespace robosim
