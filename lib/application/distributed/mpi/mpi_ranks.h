#pragma once
#include <cstddef>
#include <memory>

#include "distributed/ranks/rank_group.h"

namespace robosim {

/// Initialises MPI for calls by one thread (MPI_THREAD_FUNNELED), and finalises it when the result is destroyed, for
/// which it waits until all ranks do so. Once in a process. The processes of MPI_COMM_WORLD are the ranks.
/// @param piece_bytes size of the largest piece that is passed to MPI, whose counts are of type int; tests use small
/// ones
/// @throws std::runtime_error when MPI cannot be initialised
std::unique_ptr<RankGroup> connectMpiRanks(std::size_t piece_bytes = std::size_t{1} << 30);

}  // namespace robosim

/// connectMpiRanks() for dlsym(). The caller owns the result.
extern "C" robosim::RankGroup* robosimConnectMpiRanks();
