#!/usr/bin/env bash
# Runs the long forms of the test suites that ./dev test shortens to its budget: every suite that looks at ROBOSIM_VERIFY. Arguments are
# passed to ctest. Hours.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset release >/dev/null
cmake --build --preset release
ROBOSIM_VERIFY=1 ctest --preset release --parallel "$(nproc)" --timeout 7200 "$@"
