#!/usr/bin/env bash
# Measures the errors of icp-slam and pf-localization on a real recording (SENA, of the package mrpt-common) and on simulated
# drives along the same path among the same surfaces, and prints the figures in doc/experiments/slam_on_sena.md. An argument sets the number
# of seeds. A quarter of an hour.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_slam_errors
build/release/bin/robosim_slam_errors '/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog' \
  worlds/robots/sena_wheelchair.xml "${1:-10}"
