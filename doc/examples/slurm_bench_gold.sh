#!/bin/bash
# The gold benchmark on four nodes of 16 cores, one run at a time on each core: sbatch slurm_bench_gold.sh FOLDER
# The same command again continues the report, after the time limit, a failed node or scancel.
#SBATCH --job-name=robosim-gold
#SBATCH --nodes=4
#SBATCH --ntasks-per-node=16
#SBATCH --cpus-per-task=1
#SBATCH --time=12:00:00
#SBATCH --signal=TERM@120
#
# 120 s before the time limit all ranks receive SIGTERM, upon which they end. Finished runs are in FOLDER/journal.jsonl,
# which all nodes must see under the same name. The log of the job has a line of progress per minute.
set -eu
report=${1:?usage: sbatch slurm_bench_gold.sh FOLDER}
srun --mpi=pmix robosim bench gold gold_perfect_12 gold_cave_15 gold_office_20 --controller gold_finder \
  --controller coordinated_frontiers --controller market --controller oracle --team 1,4,16 --condition ideal \
  --condition noise+loss=0.3 --runs 100 --report "$report" --resume
