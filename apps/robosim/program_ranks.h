#pragma once
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

#include "distributed/ranks/rank_group.h"

namespace robosim {

/// The ranks of a program that mpirun or srun has started in several processes (rankGroup()). Loads the library of MPI
/// only then: a program that was started alone does not need it, and starts as fast as without it. Ranks other than 0
/// print nothing but what ends them alone.
class ProgramRanks {
 public:
  /// @throws ConfigError on rank 0 for a subcommand that runs in one process only, and without a library of MPI; other
  /// ranks then end without a message
  ProgramRanks(int argc, char** argv);
  /// Waits for all ranks.
  ~ProgramRanks();
  ProgramRanks(const ProgramRanks&) = delete;
  ProgramRanks& operator=(const ProgramRanks&) = delete;

  /// Executes the program. A failure of this rank ends all ranks. @return the exit code of this process
  int execute(const std::function<int()>& program);

 private:
  class Quiet;
  std::unique_ptr<RankGroup> group_;  ///< null for one process
  std::unique_ptr<Quiet> quiet_;      ///< of ranks other than 0
};

}  // namespace robosim
