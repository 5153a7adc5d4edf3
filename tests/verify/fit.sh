#!/usr/bin/env bash
# Fits simulated scanners of known parameters: the share of the parameters that lie within their stated intervals, and of
# the recordings that are rejected. Fails below 95 % and above 5 %. Arguments: number of seeds, 200 by default. Half an hour.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_calibration_test
ROBOSIM_VERIFY=${1:-200} build/release/bin/robosim_calibration_test --gtest_filter='FitCoverage.*'
