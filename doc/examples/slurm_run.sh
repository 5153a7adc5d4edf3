#!/bin/bash
# One world on four nodes, one rank each: sbatch slurm_run.sh WORLD
#SBATCH --job-name=robosim
#SBATCH --nodes=4
#SBATCH --ntasks-per-node=1
#SBATCH --cpus-per-task=16
#SBATCH --time=02:00:00
#SBATCH --signal=TERM@120
#
# 120 s before the time limit all ranks receive SIGTERM, upon which they end the run with complete files.
set -eu
world=${1:?usage: sbatch slurm_run.sh WORLD}
srun --mpi=pmix robosim run "$world" --threads "$SLURM_CPUS_PER_TASK" --time 600 --record run.rawlog --picture run.png
