#pragma once

namespace robosim {

/// Place of this process among those that a launcher of MPI programs, mpirun or srun, has started together.
struct LaunchedRank {
  int rank = 0;
  int size = 1;  ///< 1 for a process that was started alone
};

/// Reads the environment variables of Open MPI's mpirun (OMPI_COMM_WORLD_SIZE), of launchers with PMI (PMI_SIZE:
/// MPICH's mpiexec, srun --mpi=pmi2), and of srun --mpi=pmix (PMIX_RANK with SLURM_STEP_NUM_TASKS). Variables that
/// Slurm also sets in a batch script itself are not used: a script may run programs without srun.
LaunchedRank launchedRank();

}  // namespace robosim
