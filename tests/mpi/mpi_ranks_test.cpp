// Operations of the ranks of MPI; started by mpirun. Exit code 1 after a fault.
#include "distributed/mpi/mpi_ranks.h"

#include <cstdio>

#include "distributed/ranks/launcher.h"
#include "distributed/ranks/testing/rank_group_checks.h"

namespace {

/// @param piece_bytes small, so that messages are sent in pieces, as those beyond 2 GiB are
int faultsWith(std::size_t piece_bytes) {
  const auto group = robosim::connectMpiRanks(piece_bytes);
  const auto launched = robosim::launchedRank();
  if (group->rank() != launched.rank || group->size() != launched.size) {
    std::fprintf(stderr, "rank %d of %d, and the launcher's are %d of %d\n", group->rank(), group->size(),
                 launched.rank, launched.size);
    return 1;
  }
  const std::string fault = faultOf(*group);
  if (!fault.empty()) std::fprintf(stderr, "rank %d: %s\n", group->rank(), fault.c_str());
  return fault.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char**) { return faultsWith(argc > 1 ? 7 : std::size_t{1} << 30); }
