#!/usr/bin/env bash
# Runs on 1 to 8 ranks of MPI with 1 to 3 threads equal those of one process, byte for byte: summary, recording, table and
# picture, in all shipped worlds, with every search strategy, and in random worlds. Some minutes.
set -euo pipefail
robosim=$PWD/build/release/bin/robosim
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_mpi_yield_when_idle=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# outputs NAME COMMAND…: runs it with all outputs
outputs() {
  "${@:2}" --json --record "$folder/r.rawlog" --picture "$folder/p.png" --csv "$folder/t.csv" |
    grep -vE '"(wall_s|real_time_factor)"' >"$folder/r.json"
  (cd "$folder" && sha256sum r.json r.rawlog p.png t.csv) >"$folder/$1"
}

# compare WORLD [OPTION…]
compare() {
  local ranks threads
  outputs alone "$robosim" run "$@"
  for ranks in 1 2 3 4 5 6 7 8; do
    threads=$((1 + ranks % 3))
    outputs distributed mpirun -n "$ranks" "$robosim" run "$@" --threads "$threads" --balance $((ranks % 4))
    cmp "$folder/alone" "$folder/distributed" || {
      echo "mpi.sh: $*: $ranks ranks of $threads threads differ from one process"
      exit 1
    }
  done
  echo "same on 1 to 8 ranks: $*"
}

for world in worlds/*.xml worlds/benchmark/*.xml; do compare "$world" --time "${ROBOSIM_MPI_TIME:-5}"; done
for strategy in random_walk levy_walk wall_search heat_gradient stigmergy gold_finder coordinated_frontiers market oracle; do
  compare worlds/benchmark/gold_office_20.xml --controller $strategy --time "${ROBOSIM_MPI_TIME:-5}"
done
for seed in 1 2 3; do
  for kind in maze cave office open; do
    "$robosim" generate $kind "$folder/$kind.xml" --seed $seed >/dev/null
    compare "$folder/$kind.xml" --random-robots $((seed * 9)) --noise on --random-starts --seed $seed --time 5
  done
done
