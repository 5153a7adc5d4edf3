#!/usr/bin/env bash
# Runs on 1 to 8 ranks of MPI with 1 to 3 threads equal those of one process, byte for byte: summary, recording, table and
# picture, in all shipped worlds, with every search strategy, in mixed crowds, and in random worlds; whether ranks know all robots or
# those near their own. Half an hour.
set -euo pipefail
robosim=$PWD/build/release/bin/robosim
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_mpi_yield_when_idle=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# outputs NAME COMMAND…: runs it with all files, which rank 0 writes, so that it knows all robots
outputs() {
  summary "$@" --record "$folder/r.rawlog" --picture "$folder/p.png" --csv "$folder/t.csv"
  (cd "$folder" && sha256sum r.rawlog p.png t.csv) >>"$folder/$1"
}

# summary NAME COMMAND…: runs it without files
summary() {
  "${@:2}" --json | grep -vE '"(wall_s|real_time_factor)"' >"$folder/$1"
}

# same NAME OTHER TEXT
same() {
  cmp "$folder/$1" "$folder/$2" || {
    echo "mpi.sh: $3 differs from one process"
    exit 1
  }
}

# compare WORLD [OPTION…]
compare() {
  local ranks options exchange
  outputs alone "$robosim" run "$@"
  summary alone_without_files "$robosim" run "$@"
  for ranks in 1 2 3 4 5 6 7 8; do
    options="--threads $((1 + ranks % 3)) --balance $((ranks % 4))"
    for exchange in near auto; do
      outputs distributed mpirun -n "$ranks" "$robosim" run "$@" $options --exchange $exchange
      same alone distributed "$*: $ranks ranks, $options --exchange $exchange"
    done
    summary distributed mpirun -n "$ranks" "$robosim" run "$@" $options --exchange near
    same alone_without_files distributed "$*: $ranks ranks, $options --exchange near, without files"
  done
  echo "same on 1 to 8 ranks: $*"
}

for world in worlds/*.xml worlds/benchmark/*.xml; do compare "$world" --time "${ROBOSIM_MPI_TIME:-5}"; done
for strategy in random_walk levy_walk wall_search heat_gradient stigmergy gold_finder coordinated_frontiers market oracle; do
  compare worlds/benchmark/gold_office_20.xml --controller $strategy --time "${ROBOSIM_MPI_TIME:-5}"
done
for seed in 1 2 3 4; do
  tests/verify/mixed_world.py $seed "$folder"
  compare "$folder/mixed_$seed.xml" --time 3
done
for seed in 1 2 3; do
  for kind in maze cave office open; do
    "$robosim" generate $kind "$folder/$kind.xml" --seed $seed >/dev/null
    compare "$folder/$kind.xml" --random-robots $((seed * 9)) --noise on --random-starts --seed $seed --time 5
  done
done
