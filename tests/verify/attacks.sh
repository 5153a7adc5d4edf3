#!/usr/bin/env bash
# Runs the attack tests on a server at full length: a million reset streams through the reverse proxy, silent connections
# up to their limits, floods of random bytes. Prints the figures in doc/security.md. Some minutes, on an idle machine.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_program robosim_scenarios_test
ROBOSIM_VERIFY=1 build/release/bin/robosim_scenarios_test --gtest_filter='Attack.*:ReverseProxy.*:Flood.*'
