#!/usr/bin/env bash
# Movable objects in 10,000 random worlds: nothing overlaps by more than 1 nm, and the energy of objects among themselves never
# grows. 10 seconds after the build.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_dynamics_test
ROBOSIM_VERIFY=1 build/release/bin/robosim_dynamics_test --gtest_filter='ObjectMover.*'
